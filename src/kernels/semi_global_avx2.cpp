// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/semi_global.h"

// All disparities of a pixel are one vector.

namespace darkling {
namespace {

constexpr int D = kDisparities;

__m256i load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}
void store(void* to, __m256i value) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), value);
}

// The vector that begins at D - 1 - x is 255 where d > x.
struct BeyondTable {
  std::uint8_t bytes[2 * D];
  constexpr BeyondTable() : bytes() {
    for (int i = 0; i < 2 * D; ++i) bytes[i] = i < D ? 0 : 255;
  }
};
constexpr BeyondTable kBeyond;

// 255 for the disparities that reach beyond the right image from column x.
__m256i beyond(int x) {
  return load(kBeyond.bytes + D - 1 - (x < D - 1 ? x : D - 1));
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

// The costs of one pixel on one of the paths from above.
__m256i step_from_above(__m256i cost, const Penalties& p, const std::uint8_t* before,
                        std::uint8_t least, std::uint8_t* now, std::uint8_t* least_now) {
  const __m256i path = step_path(cost, p, load(before - 1), load(before), load(before + 1),
                                 _mm256_set1_epi8(static_cast<char>(least)));
  store(now, path);
  *least_now = least_byte(path);
  return path;
}

// Hamming distances of one column of pixels, summed over the three rows.
__m256i sum_column(const std::uint8_t* const hamming[3], int x) {
  return _mm256_add_epi8(_mm256_add_epi8(load(hamming[0] + x * D), load(hamming[1] + x * D)),
                         load(hamming[2] + x * D));
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
  const int before = paths.parity;
  const int now = 1 - before;
  PathAlong along;
  __m256i left = sum_column(hamming, 0);
  __m256i here = left;
  for (int x = 0; x < width; ++x) {
    const __m256i right = sum_column(hamming, x + 1 < width ? x + 1 : x);
    const __m256i cost = _mm256_add_epi8(_mm256_add_epi8(left, here), right);
    left = here;
    here = right;
    store(row.cost + x * D, cost);
    __m256i path[3];
    for (int direction = 0; direction < 3; ++direction) {
      const int from = x + direction;  // a guard pixel at the left end: x - 1, x, x + 1
      path[direction] =
          step_from_above(cost, p, paths.costs[direction][before] + from * kPathStride + kPathGuard,
                          paths.minima[direction][before][from],
                          paths.costs[direction][now] + (x + 1) * kPathStride + kPathGuard,
                          paths.minima[direction][now] + x + 1);
    }
    const __m256i last = along.step(cost, p);
    const auto add = [&](__m256i (*half)(__m256i)) {
      return _mm256_add_epi16(_mm256_add_epi16(half(path[0]), half(path[1])),
                              _mm256_add_epi16(half(path[2]), half(last)));
    };
    store(row.sum + x * D, add(low_half));
    store(row.sum + x * D + D / 2, add(high_half));
  }
}

std::uint16_t least_word(__m256i a, __m256i b) {
  const __m256i sixteen = _mm256_min_epu16(a, b);
  const __m128i eight =
      _mm_min_epu16(_mm256_castsi256_si128(sixteen), _mm256_extracti128_si256(sixteen, 1));
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(eight)));
}

void keep_least(std::uint16_t* to, __m256i keys) {
  store(to, _mm256_min_epu16(load(to), keys));
}

// The fifth path, from the right, and the winners, now that all sums are there.
void walk_left(const Penalties& p, int width, const StereoRow& row) {
  const __m256i low_d = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m256i high_d = _mm256_add_epi16(low_d, _mm256_set1_epi16(16));
  for (int i = 0; i < width + D; ++i) row.right_winner[i] = 0xffff;
  PathAlong along;
  for (int x = width - 1; x >= 0; --x) {
    const __m256i path = along.step(load(row.cost + x * D), p);
    const __m256i low = _mm256_add_epi16(load(row.sum + x * D), low_half(path));
    const __m256i high = _mm256_add_epi16(load(row.sum + x * D + D / 2), high_half(path));
    store(row.sum + x * D, low);
    store(row.sum + x * D + D / 2, high);
    const __m256i low_key = _mm256_or_si256(_mm256_slli_epi16(low, 5), low_d);
    const __m256i high_key = _mm256_or_si256(_mm256_slli_epi16(high, 5), high_d);
    keep_least(row.right_winner + width - 1 - x, low_key);
    keep_least(row.right_winner + width - 1 - x + D / 2, high_key);
    const __m256i outside = beyond(x);
    const __m128i low_out = _mm256_castsi256_si128(outside);
    const __m128i high_out = _mm256_extracti128_si256(outside, 1);
    row.left_winner[x] = least_word(_mm256_or_si256(low_key, _mm256_cvtepi8_epi16(low_out)),
                                    _mm256_or_si256(high_key, _mm256_cvtepi8_epi16(high_out)));
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
    store(cost + x * D, x < D - 1 ? _mm256_blendv_epi8(bits, all, beyond(x)) : bits);
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
