// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/semi_global.h"

// All disparities of a pixel are two vectors.

namespace darkling {
namespace {

constexpr int kD = kDisparities;
constexpr int kHalf = kD / 2;  // bytes of a vector

__m128i load(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}
void store(void* to, __m128i value) {
  _mm_storeu_si128(static_cast<__m128i*>(to), value);
}

// A byte each for all disparities.
struct Bytes {
  __m128i low;
  __m128i high;
};

Bytes load_all(const std::uint8_t* from) {
  return {load(from), load(from + kHalf)};
}
void store_all(std::uint8_t* to, const Bytes& bytes) {
  store(to, bytes.low);
  store(to + kHalf, bytes.high);
}
Bytes add(const Bytes& a, const Bytes& b) {
  return {_mm_add_epi8(a.low, b.low), _mm_add_epi8(a.high, b.high)};
}

// The vectors that begin at kD - 1 - x are 255 where d > x.
struct BeyondTable {
  std::uint8_t bytes[2 * kD];
  constexpr BeyondTable() : bytes() {
    for (int i = 0; i < 2 * kD; ++i) bytes[i] = i < kD ? 0 : 255;
  }
};
constexpr BeyondTable kBeyond;

// 255 for the disparities that reach beyond the right image from column x.
Bytes beyond(int x) {
  return load_all(kBeyond.bytes + kD - 1 - (x < kD - 1 ? x : kD - 1));
}

__m128i count_bits(__m128i bytes) {
  const __m128i counts = _mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const __m128i nibble = _mm_set1_epi8(15);
  const __m128i low = _mm_and_si128(bytes, nibble);
  const __m128i high = _mm_and_si128(_mm_srli_epi16(bytes, 4), nibble);
  return _mm_add_epi8(_mm_shuffle_epi8(counts, low), _mm_shuffle_epi8(counts, high));
}

// The least of all bytes, in the lowest one.
__m128i least_byte(const Bytes& bytes) {
  const __m128i sixteen = _mm_min_epu8(bytes.low, bytes.high);
  return _mm_minpos_epu16(_mm_min_epu8(sixteen, _mm_srli_epi16(sixteen, 8)));
}

struct Penalties {
  __m128i small_step;
  __m128i large_step;
};

// Hirschmüller 2008, eq. (13), for half the disparities. What saturates is never the least.
__m128i step_half(__m128i cost, const Penalties& p, __m128i below, __m128i stay, __m128i above,
                  __m128i least) {
  const __m128i step = _mm_adds_epu8(_mm_min_epu8(below, above), p.small_step);
  const __m128i jump = _mm_add_epi8(least, p.large_step);
  const __m128i best = _mm_min_epu8(_mm_min_epu8(stay, step), jump);
  return _mm_add_epi8(cost, _mm_sub_epi8(best, least));
}

// The path along a row, kept in registers.
struct PathAlong {
  Bytes costs = {_mm_setzero_si128(), _mm_setzero_si128()};
  __m128i least = _mm_setzero_si128();

  void step(const Bytes& cost, const Penalties& p) {
    const __m128i guard = _mm_set1_epi8(-1);
    const auto [low, high] = costs;
    costs.low = step_half(cost.low, p, _mm_alignr_epi8(low, guard, 15), low,
                          _mm_alignr_epi8(high, low, 1), least);
    costs.high = step_half(cost.high, p, _mm_alignr_epi8(high, low, 15), high,
                           _mm_alignr_epi8(guard, high, 1), least);
    least = _mm_shuffle_epi8(least_byte(costs), _mm_setzero_si128());
  }
};

// The costs of one pixel on one of the paths from above.
Bytes step_from_above(const Bytes& cost, const Penalties& p, const std::uint8_t* before,
                      std::uint8_t least_before, std::uint8_t* now, std::uint8_t* least_now) {
  const __m128i least = _mm_set1_epi8(static_cast<char>(least_before));
  const auto half = [&](__m128i c, const std::uint8_t* from) {
    return step_half(c, p, load(from - 1), load(from), load(from + 1), least);
  };
  const Bytes path = {half(cost.low, before), half(cost.high, before + kHalf)};
  store_all(now, path);
  *least_now = static_cast<std::uint8_t>(_mm_cvtsi128_si32(least_byte(path)));
  return path;
}

// Hamming distances of one column of pixels, summed over the three rows.
Bytes sum_column(const std::uint8_t* const hamming[3], int x) {
  return add(add(load_all(hamming[0] + x * kD), load_all(hamming[1] + x * kD)),
             load_all(hamming[2] + x * kD));
}

// The 16-bit numbers of disparities 8 i … 8 i + 7.
__m128i widen(const Bytes& bytes, int i) {
  const __m128i half = i < 2 ? bytes.low : bytes.high;
  return i % 2 == 0 ? _mm_cvtepu8_epi16(half) : _mm_unpackhi_epi8(half, _mm_setzero_si128());
}

// The four paths that have arrived when a row is walked from the left: matching costs, path costs
// for the row below, and the sum so far.
void walk_right(const std::uint8_t* const hamming[3], const Penalties& p, const PathRows& paths,
                const StereoRow& row) {
  const int width = paths.width;
  const int before = paths.parity;
  const int now = 1 - before;
  PathAlong along;
  Bytes left = sum_column(hamming, 0);
  Bytes here = left;
  for (int x = 0; x < width; ++x) {
    const Bytes right = sum_column(hamming, x + 1 < width ? x + 1 : x);
    const Bytes cost = add(add(left, here), right);
    left = here;
    here = right;
    store_all(row.cost + x * kD, cost);
    Bytes path[3];
    for (int direction = 0; direction < 3; ++direction) {
      const int from = x + direction;  // a guard pixel at the left end: x - 1, x, x + 1
      path[direction] =
          step_from_above(cost, p, paths.costs[direction][before] + from * kPathStride + kPathGuard,
                          paths.minima[direction][before][from],
                          paths.costs[direction][now] + (x + 1) * kPathStride + kPathGuard,
                          paths.minima[direction][now] + x + 1);
    }
    along.step(cost, p);
    for (int i = 0; i < 4; ++i) {
      store(row.sum + x * kD + 8 * i,
            _mm_add_epi16(_mm_add_epi16(widen(path[0], i), widen(path[1], i)),
                          _mm_add_epi16(widen(path[2], i), widen(along.costs, i))));
    }
  }
}

// The least keys of the right pixels that a left pixel's disparities reach, the nearest first. From
// one left pixel to the next they move on by one, and the nearest is complete. Kept in registers: a
// load from where other vectors have just been stored in part would wait for them.
struct RightWinners {
  __m128i quarters[4];

  std::uint16_t take(const __m128i keys[4]) {
    for (int i = 0; i < 4; ++i) quarters[i] = _mm_min_epu16(quarters[i], keys[i]);
    const auto nearest = static_cast<std::uint16_t>(_mm_cvtsi128_si32(quarters[0]));
    for (int i = 0; i < 3; ++i) quarters[i] = _mm_alignr_epi8(quarters[i + 1], quarters[i], 2);
    quarters[3] = _mm_alignr_epi8(_mm_set1_epi16(-1), quarters[3], 2);
    return nearest;
  }
};

// The fifth path, from the right, and the winners, now that all sums are there.
void walk_left(const Penalties& p, int width, const StereoRow& row) {
  const __m128i first_d = _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7);
  const __m128i none = _mm_set1_epi16(-1);
  RightWinners right = {{none, none, none, none}};
  PathAlong along;
  for (int x = width - 1; x >= 0; --x) {
    along.step(load_all(row.cost + x * kD), p);
    const Bytes outside = beyond(x);
    __m128i least = none;
    __m128i keys[4];
    for (int i = 0; i < 4; ++i) {
      std::uint16_t* to = row.sum + x * kD + 8 * i;
      const __m128i sum = _mm_add_epi16(load(to), widen(along.costs, i));
      store(to, sum);
      const __m128i d = _mm_add_epi16(first_d, _mm_set1_epi16(static_cast<short>(8 * i)));
      keys[i] = _mm_or_si128(_mm_slli_epi16(sum, 5), d);
      const __m128i half = i < 2 ? outside.low : outside.high;
      const __m128i out =
          i % 2 == 0 ? _mm_unpacklo_epi8(half, half) : _mm_unpackhi_epi8(half, half);
      least = _mm_min_epu16(least, _mm_or_si128(keys[i], out));
    }
    row.right_winner[width - 1 - x] = right.take(keys);
    row.left_winner[x] = static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(least)));
  }
}

}  // namespace

void hamming_row_sse41(const std::uint8_t* left, const std::uint8_t* right_reversed, int width,
                       std::uint8_t* cost) {
  const __m128i all = _mm_set1_epi8(8);
  for (int x = 0; x < width; ++x) {
    const __m128i code = _mm_set1_epi8(static_cast<char>(left[x]));
    const Bytes right = load_all(right_reversed + width - 1 - x);
    const Bytes out = beyond(x);
    store_all(cost + x * kD,
              {_mm_blendv_epi8(count_bits(_mm_xor_si128(code, right.low)), all, out.low),
               _mm_blendv_epi8(count_bits(_mm_xor_si128(code, right.high)), all, out.high)});
  }
}

void semi_global_row_sse41(const std::uint8_t* const hamming[3], SemiGlobalPenalties penalties,
                           PathRows& paths, const StereoRow& row) {
  const Penalties p = {_mm_set1_epi8(static_cast<char>(penalties.small_step)),
                       _mm_set1_epi8(static_cast<char>(penalties.large_step))};
  walk_right(hamming, p, paths, row);
  walk_left(p, paths.width, row);
  paths.parity = 1 - paths.parity;
}

}  // namespace darkling
