// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/bit_planes.h"
#include "kernels/bit_planes_rows.h"

namespace darkling {
namespace {

constexpr int kBytes = 16;  // a vector

__m128i load(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}
void store(void* to, __m128i value) {
  _mm_storeu_si128(static_cast<__m128i*>(to), value);
}

// [1 2 1] down the columns x … x + 15, as 16-bit numbers.
struct Columns {
  __m128i low;
  __m128i high;
};

Columns columns_at(const BlurRow& row, int x) {
  const __m128i zero = _mm_setzero_si128();
  const __m128i above = load(row.above + x);
  const __m128i here = load(row.here + x);
  const __m128i below = load(row.below + x);
  const auto column = [](__m128i a, __m128i h, __m128i b) {
    return _mm_add_epi16(_mm_add_epi16(a, b), _mm_slli_epi16(h, 1));
  };
  return {column(_mm_cvtepu8_epi16(above), _mm_cvtepu8_epi16(here), _mm_cvtepu8_epi16(below)),
          column(_mm_unpackhi_epi8(above, zero), _mm_unpackhi_epi8(here, zero),
                 _mm_unpackhi_epi8(below, zero))};
}

// [1 2 1] along the row, rounded.
__m128i blur_8(__m128i left, __m128i here, __m128i right) {
  const __m128i sum = _mm_add_epi16(_mm_add_epi16(left, right), _mm_slli_epi16(here, 1));
  return _mm_srli_epi16(_mm_add_epi16(sum, _mm_set1_epi16(8)), 4);
}

void blur_16(const BlurRow& row, int x) {
  const Columns left = columns_at(row, x - 1);
  const Columns right = columns_at(row, x + 1);
  const __m128i low_here = _mm_alignr_epi8(left.high, left.low, 2);
  const __m128i high_here = _mm_alignr_epi8(right.high, right.low, 14);
  store(row.blurred + x, _mm_packus_epi16(blur_8(left.low, low_here, right.low),
                                          blur_8(left.high, high_here, right.high)));
}

void blur_row(const BlurRow& row) {
  const int last = row.width - 1;
  if (last - 1 < kBytes) {
    blur_columns(row, 0, row.width);
    return;
  }
  const BlurRow local = row;  // else each store might have moved the pointers
  for (int x = 1; x + kBytes <= last; x += kBytes) blur_16(local, x);
  blur_16(local, last - kBytes);  // overlaps the one before: no read goes past the row
  blur_columns(row, 0, 1);
  blur_columns(row, last, row.width);
}

// Grey levels with the top bit flipped, for a comparison that knows only signed bytes.
__m128i as_signed(__m128i levels) {
  return _mm_xor_si128(levels, _mm_set1_epi8(-128));
}

// Moves the codes one bit down and puts the next neighbour's bit on top. A rounded average with a
// mask of 0 or 255 does both, without rounding: seven moves leave the lowest bit clear.
void census_16(const CensusRow& row, int x) {
  const std::uint8_t* const neighbours[kPlaneCount] = {
      row.above + x - 1, row.above + x,     row.above + x + 1, row.here + x - 1,
      row.here + x + 1,  row.below + x - 1, row.below + x,     row.below + x + 1};
  const __m128i centre = load(row.here + x);
  const __m128i dead_zone = _mm_set1_epi8(static_cast<char>(row.dead_zone));
  const __m128i high = as_signed(_mm_adds_epu8(centre, dead_zone));
  const __m128i low = as_signed(_mm_subs_epu8(centre, dead_zone));
  __m128i brighter = _mm_setzero_si128();
  __m128i above_low = _mm_setzero_si128();
  for (const std::uint8_t* neighbour : neighbours) {
    const __m128i level = as_signed(load(neighbour));
    brighter = _mm_avg_epu8(brighter, _mm_cmpgt_epi8(level, high));
    above_low = _mm_avg_epu8(above_low, _mm_cmpgt_epi8(level, low));
  }
  store(row.brighter + x, brighter);
  // Nothing is darker than black by the dead zone.
  const __m128i has_darker = _mm_cmpeq_epi8(_mm_max_epu8(centre, dead_zone), centre);
  store(row.darker + x, _mm_andnot_si128(above_low, has_darker));
}

void census_row(const CensusRow& row) {
  const CensusRow local = row;
  for (int x = 0; x < local.width; x += kBytes) census_16(local, x);
}

__m128i smooth(__m128i before, __m128i here, __m128i after) {
  return _mm_avg_epu8(_mm_avg_epu8(before, after), here);
}

// The bits of two pixels' codes, each in a byte of its own, all others of which are zero.
__m128i bits_of(const std::uint8_t* codes) {
  const __m128i pixel = _mm_setr_epi8(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
  const __m128i bit = _mm_set1_epi64x(static_cast<long long>(0x8040'2010'0804'0201ULL));
  return _mm_and_si128(_mm_shuffle_epi8(_mm_cvtsi32_si128(codes[0] | codes[1] << 8), pixel), bit);
}

// Two pixels' planes: 255 brighter, 0 darker, 128 neither.
__m128i spread(const std::uint8_t* brighter, const std::uint8_t* darker) {
  const __m128i zero = _mm_setzero_si128();
  const __m128i is_not_brighter = _mm_cmpeq_epi8(bits_of(brighter), zero);
  const __m128i is_not_darker = _mm_cmpeq_epi8(bits_of(darker), zero);
  return _mm_avg_epu8(_mm_xor_si128(is_not_brighter, _mm_set1_epi8(-1)), is_not_darker);
}

void smooth_down_row(const DownRow& row) {
  const DownRow local = row;
  for (int x = 0; x < local.width; x += 2) {
    const int i = x * kPlaneCount;
    __m128i m = spread(local.brighter + x, local.darker + x);
    for (int pass = 0; pass < 3; ++pass) {
      const __m128i out = smooth(load(local.older[pass] + i), load(local.newer[pass] + i), m);
      store(local.older[pass] + i, m);
      m = out;
    }
    store(local.out + i, m);
  }
}

// One pass along the row, two pixels at a time.
struct AlongPass {
  __m128i here = _mm_setzero_si128();    // pixels 2k, 2k + 1
  __m128i before = _mm_setzero_si128();  // their left neighbours

  // Takes the next two pixels in and gives the smoothed ones before them.
  __m128i push(__m128i next) {
    const __m128i after = _mm_alignr_epi8(next, here, kPlaneCount);
    const __m128i smoothed = smooth(before, here, after);
    before = after;  // what lies right of these two lies left of the next
    here = next;
    return smoothed;
  }
};

// The three passes in one, each two pixels behind the one before: that is six, the last three of
// which are read from the margin but have no weight.
void smooth_along_row(const AlongRow& row) {
  const AlongRow local = row;
  AlongPass passes[3];
  const auto push = [&passes, &local](int x) {
    const __m128i in = load(local.in + x * kPlaneCount);
    return passes[2].push(passes[1].push(passes[0].push(in)));
  };
  for (int x = -4; x < 6; x += 2) push(x);
  int x = 0;
  for (; x + 2 <= local.width; x += 2) store(local.out + x * kPlaneCount, push(x + 6));
  if (x == local.width) return;
  _mm_storel_epi64(reinterpret_cast<__m128i*>(local.out + x * kPlaneCount), push(x + 6));
}

}  // namespace

void bit_planes_sse41(ImageView<const std::uint8_t> grey, int dead_zone,
                      ImageView<std::uint8_t> codes, std::span<std::uint8_t> scratch,
                      ImageView<std::uint8_t> planes) {
  bit_planes_by_rows(grey, dead_zone, codes, scratch, planes,
                     {blur_row, census_row, smooth_down_row, smooth_along_row});
}

}  // namespace darkling
