// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/semi_global.h"

// All disparities of a pixel are one vector.

namespace darkling {
namespace {

constexpr int kD = kDisparities;

__m256i load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}
void store(void* to, __m256i value) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), value);
}

// The vector that begins at D - 1 - x is 255 where d > x.
struct BeyondTable {
  std::uint8_t bytes[2 * kD];
  constexpr BeyondTable() : bytes() {
    for (int i = 0; i < 2 * kD; ++i) bytes[i] = i < kD ? 0 : 255;
  }
};
constexpr BeyondTable kBeyond;

// 255 for the disparities that reach beyond the right image from column x.
__m256i beyond(int x) {
  return load(kBeyond.bytes + kD - 1 - (x < kD - 1 ? x : kD - 1));
}

__m256i count_bits(__m256i bytes) {
  const __m256i counts =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
  const __m256i nibble = _mm256_set1_epi8(15);
  const __m256i low = _mm256_and_si256(bytes, nibble);
  const __m256i high = _mm256_and_si256(_mm256_srli_epi16(bytes, 4), nibble);
  return _mm256_add_epi8(_mm256_shuffle_epi8(counts, low), _mm256_shuffle_epi8(counts, high));
}

std::uint8_t least_byte(__m256i bytes) {
  const __m128i sixteen =
      _mm_min_epu8(_mm256_castsi256_si128(bytes), _mm256_extracti128_si256(bytes, 1));
  const __m128i eight = _mm_min_epu8(sixteen, _mm_srli_epi16(sixteen, 8));
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(eight)));
}

struct Penalties {
  __m256i small_step;
  __m256i large_step;
};

// Hirschmüller 2008, eq. (13), for all disparities at once. What saturates is never the least.
__m256i step_path(__m256i cost, const Penalties& p, __m256i below, __m256i stay, __m256i above,
                  __m256i least) {
  const __m256i step = _mm256_adds_epu8(_mm256_min_epu8(below, above), p.small_step);
  const __m256i jump = _mm256_add_epi8(least, p.large_step);
  const __m256i best = _mm256_min_epu8(_mm256_min_epu8(stay, step), jump);
  return _mm256_add_epi8(cost, _mm256_sub_epi8(best, least));
}

// The path along a row, kept in registers.
struct PathAlong {
  __m256i costs = _mm256_setzero_si256();
  __m256i least = _mm256_setzero_si256();

  __m256i step(__m256i cost, const Penalties& p) {
    const __m256i guard = _mm256_set1_epi8(-1);
    const __m256i low_end = _mm256_permute2x128_si256(costs, guard, 0x02);   // guard, low half
    const __m256i high_end = _mm256_permute2x128_si256(costs, guard, 0x21);  // high half, guard
    costs = step_path(cost, p, _mm256_alignr_epi8(costs, low_end, 15), costs,
                      _mm256_alignr_epi8(high_end, costs, 1), least);
    const __m128i sixteen =
        _mm_min_epu8(_mm256_castsi256_si128(costs), _mm256_extracti128_si256(costs, 1));
    const __m128i eight = _mm_min_epu8(sixteen, _mm_srli_epi16(sixteen, 8));
    least = _mm256_broadcastb_epi8(_mm_minpos_epu16(eight));
    return costs;
  }
};

// One of the paths from above: its costs and minima in the row before, shifted so that index x is
// where the path to pixel x comes from, and in this row.
struct PathAbove {
  const std::uint8_t* before;
  const std::uint8_t* least_before;
  std::uint8_t* now;
  std::uint8_t* least_now;

  __m256i step(int x, __m256i cost, const Penalties& p) const {
    const std::uint8_t* from = before + x * kPathStride;
    const __m256i least = _mm256_set1_epi8(static_cast<char>(least_before[x]));
    const __m256i path = step_path(cost, p, load(from - 1), load(from), load(from + 1), least);
    store(now + x * kPathStride, path);
    least_now[x] = least_byte(path);
    return path;
  }
};

PathAbove path_above(const PathRows& paths, int direction) {
  const int before = paths.parity;
  const int now = 1 - before;
  // A guard pixel at the left end: pixel x is at x + 1, and comes from x - 1, x or x + 1.
  return {paths.costs[direction][before] + direction * kPathStride + kPathGuard,
          paths.minima[direction][before] + direction,
          paths.costs[direction][now] + kPathStride + kPathGuard, paths.minima[direction][now] + 1};
}

// Hamming distances of one column of pixels, summed over the three rows.
__m256i sum_column(const std::uint8_t* const hamming[3], int x) {
  return _mm256_add_epi8(_mm256_add_epi8(load(hamming[0] + x * kD), load(hamming[1] + x * kD)),
                         load(hamming[2] + x * kD));
}

// 16-bit numbers, in the order of the bytes.
__m256i low_half(__m256i bytes) {
  return _mm256_cvtepu8_epi16(_mm256_castsi256_si128(bytes));
}
__m256i high_half(__m256i bytes) {
  return _mm256_cvtepu8_epi16(_mm256_extracti128_si256(bytes, 1));
}

// The four paths that have arrived when a row is walked from the left: matching costs, path costs
// for the row below, and the sum so far.
void walk_right(const std::uint8_t* const hamming[3], const Penalties& p, const PathRows& paths,
                const StereoRow& row) {
  const int width = paths.width;
  const PathAbove from_left = path_above(paths, 0);
  const PathAbove from_above = path_above(paths, 1);
  const PathAbove from_right = path_above(paths, 2);
  const std::uint8_t* const rows[3] = {hamming[0], hamming[1], hamming[2]};
  std::uint8_t* const costs = row.cost;
  std::uint16_t* const sums = row.sum;
  PathAlong along;
  __m256i left = sum_column(rows, 0);
  __m256i here = left;
  for (int x = 0; x < width; ++x) {
    const __m256i right = sum_column(rows, x + 1 < width ? x + 1 : x);
    const __m256i cost = _mm256_add_epi8(_mm256_add_epi8(left, here), right);
    left = here;
    here = right;
    store(costs + x * kD, cost);
    const __m256i a = from_left.step(x, cost, p);
    const __m256i b = from_above.step(x, cost, p);
    const __m256i c = from_right.step(x, cost, p);
    const __m256i d = along.step(cost, p);
    store(sums + x * kD, _mm256_add_epi16(_mm256_add_epi16(low_half(a), low_half(b)),
                                          _mm256_add_epi16(low_half(c), low_half(d))));
    store(sums + x * kD + kD / 2, _mm256_add_epi16(_mm256_add_epi16(high_half(a), high_half(b)),
                                                   _mm256_add_epi16(high_half(c), high_half(d))));
  }
}

std::uint16_t least_word(__m256i a, __m256i b) {
  const __m256i sixteen = _mm256_min_epu16(a, b);
  const __m128i eight =
      _mm_min_epu16(_mm256_castsi256_si128(sixteen), _mm256_extracti128_si256(sixteen, 1));
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(eight)));
}

// The winner keys of one pixel.
struct Keys {
  __m256i low;
  __m256i high;
};

Keys make_keys(__m256i low_sum, __m256i high_sum) {
  const __m256i low_d = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m256i high_d = _mm256_add_epi16(low_d, _mm256_set1_epi16(16));
  return {_mm256_or_si256(_mm256_slli_epi16(low_sum, 5), low_d),
          _mm256_or_si256(_mm256_slli_epi16(high_sum, 5), high_d)};
}

// The least key of those whose disparity lies inside the right image.
std::uint16_t least_inside(const Keys& keys, int x) {
  const __m256i outside = beyond(x);
  const __m256i low = _mm256_cvtepi8_epi16(_mm256_castsi256_si128(outside));
  const __m256i high = _mm256_cvtepi8_epi16(_mm256_extracti128_si256(outside, 1));
  return least_word(_mm256_or_si256(keys.low, low), _mm256_or_si256(keys.high, high));
}

// The least keys of the right pixels that a left pixel's disparities reach, the nearest first. From
// one left pixel to the next they move on by one, and the nearest is complete. Kept in registers: a
// load from where other vectors have just been stored in part would wait for them.
struct RightWinners {
  __m256i low = _mm256_set1_epi16(-1);
  __m256i high = _mm256_set1_epi16(-1);

  std::uint16_t take(const Keys& keys) {
    low = _mm256_min_epu16(low, keys.low);
    high = _mm256_min_epu16(high, keys.high);
    const auto nearest = static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm256_castsi256_si128(low)));
    const __m256i middle = _mm256_permute2x128_si256(low, high, 0x21);
    const __m256i none = _mm256_set1_epi16(-1);
    low = _mm256_alignr_epi8(middle, low, 2);
    high = _mm256_alignr_epi8(_mm256_permute2x128_si256(high, none, 0x21), high, 2);
    return nearest;
  }
};

// The fifth path, from the right, and the winners, now that all sums are there.
void walk_left(const Penalties& p, int width, const StereoRow& row) {
  const StereoRow local = row;  // else each store might have moved the pointers
  PathAlong along;
  RightWinners right;
  for (int x = width - 1; x >= 0; --x) {
    const __m256i path = along.step(load(local.cost + x * kD), p);
    std::uint16_t* const sum = local.sum + x * kD;
    const __m256i low = _mm256_add_epi16(load(sum), low_half(path));
    const __m256i high = _mm256_add_epi16(load(sum + kD / 2), high_half(path));
    store(sum, low);
    store(sum + kD / 2, high);
    const Keys keys = make_keys(low, high);
    local.right_winner[width - 1 - x] = right.take(keys);
    local.left_winner[x] = x < kD - 1 ? least_inside(keys, x) : least_word(keys.low, keys.high);
  }
}

}  // namespace

void hamming_row_avx2(const std::uint8_t* left, const std::uint8_t* right_reversed, int width,
                      std::uint8_t* cost) {
  const __m256i all = _mm256_set1_epi8(8);
  for (int x = 0; x < width; ++x) {
    const __m256i code = _mm256_set1_epi8(static_cast<char>(left[x]));
    const __m256i differ = _mm256_xor_si256(code, load(right_reversed + width - 1 - x));
    const __m256i bits = count_bits(differ);
    store(cost + x * kD, x < kD - 1 ? _mm256_blendv_epi8(bits, all, beyond(x)) : bits);
  }
}

void semi_global_row_avx2(const std::uint8_t* const hamming[3], SemiGlobalPenalties penalties,
                          PathRows& paths, const StereoRow& row) {
  const Penalties p = {_mm256_set1_epi8(static_cast<char>(penalties.small_step)),
                       _mm256_set1_epi8(static_cast<char>(penalties.large_step))};
  walk_right(hamming, p, paths, row);
  walk_left(p, paths.width, row);
  paths.parity = 1 - paths.parity;
}

}  // namespace darkling
