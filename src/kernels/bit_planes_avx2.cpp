// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/bit_planes.h"
#include "kernels/bit_planes_rows.h"

namespace darkling {
namespace {

constexpr int kBytes = 32;  // a vector

__m256i load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}
void store(void* to, __m256i value) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), value);
}
// Sixteen bytes as 16-bit numbers.
__m256i widen(const std::uint8_t* from) {
  return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
}

// Sixteen blurred pixels, as 16-bit numbers.
__m256i blur_16(const BlurRow& row, int x) {
  const auto column = [&row](int i) {
    const __m256i twice = _mm256_slli_epi16(widen(row.here + i), 1);
    return _mm256_add_epi16(_mm256_add_epi16(widen(row.above + i), widen(row.below + i)), twice);
  };
  const __m256i sides = _mm256_add_epi16(column(x - 1), column(x + 1));
  const __m256i sum = _mm256_add_epi16(sides, _mm256_slli_epi16(column(x), 1));
  return _mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16(8)), 4);
}

void blur_32(const BlurRow& row, int x) {
  const __m256i mixed = _mm256_packus_epi16(blur_16(row, x), blur_16(row, x + 16));
  store(row.blurred + x, _mm256_permute4x64_epi64(mixed, 0b11'01'10'00));
}

void blur_row(const BlurRow& row) {
  const int last = row.width - 1;
  if (last - 1 < kBytes) {
    blur_columns(row, 0, row.width);
    return;
  }
  const BlurRow local = row;  // else each store might have moved the pointers
  for (int x = 1; x + kBytes <= last; x += kBytes) blur_32(local, x);
  blur_32(local, last - kBytes);  // overlaps the one before: no read goes past the row
  blur_columns(row, 0, 1);
  blur_columns(row, last, row.width);
}

// Grey levels with the top bit flipped, for a comparison that knows only signed bytes.
__m256i as_signed(__m256i levels) {
  return _mm256_xor_si256(levels, _mm256_set1_epi8(-128));
}

// Moves the codes one bit down and puts the next neighbour's bit on top. A rounded average with a
// mask of 0 or 255 does both, without rounding: seven moves leave the lowest bit clear.
void census_32(const CensusRow& row, int x) {
  const std::uint8_t* const neighbours[kPlaneCount] = {
      row.above + x - 1, row.above + x,     row.above + x + 1, row.here + x - 1,
      row.here + x + 1,  row.below + x - 1, row.below + x,     row.below + x + 1};
  const __m256i centre = load(row.here + x);
  const __m256i dead_zone = _mm256_set1_epi8(static_cast<char>(row.dead_zone));
  const __m256i high = as_signed(_mm256_adds_epu8(centre, dead_zone));
  const __m256i low = as_signed(_mm256_subs_epu8(centre, dead_zone));
  __m256i brighter = _mm256_setzero_si256();
  __m256i above_low = _mm256_setzero_si256();
  for (const std::uint8_t* neighbour : neighbours) {
    const __m256i level = as_signed(load(neighbour));
    brighter = _mm256_avg_epu8(brighter, _mm256_cmpgt_epi8(level, high));
    above_low = _mm256_avg_epu8(above_low, _mm256_cmpgt_epi8(level, low));
  }
  store(row.brighter + x, brighter);
  // Nothing is darker than black by the dead zone.
  const __m256i has_darker = _mm256_cmpeq_epi8(_mm256_max_epu8(centre, dead_zone), centre);
  store(row.darker + x, _mm256_andnot_si256(above_low, has_darker));
}

void census_row(const CensusRow& row) {
  const CensusRow local = row;
  for (int x = 0; x < local.width; x += kBytes) census_32(local, x);
}

__m256i smooth(__m256i before, __m256i here, __m256i after) {
  return _mm256_avg_epu8(_mm256_avg_epu8(before, after), here);
}

// The bits of four pixels' codes, each in a byte of its own, all others of which are zero.
__m256i bits_of(const std::uint8_t* codes) {
  const __m256i pixel = _mm256_setr_epi8(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2,
                                         2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3);
  const __m256i bit = _mm256_set1_epi64x(static_cast<long long>(0x8040'2010'0804'0201ULL));
  std::int32_t four = 0;
  __builtin_memcpy(&four, codes, sizeof(four));
  return _mm256_and_si256(_mm256_shuffle_epi8(_mm256_set1_epi32(four), pixel), bit);
}

// Four pixels' planes: 255 brighter, 0 darker, 128 neither.
__m256i spread(const std::uint8_t* brighter, const std::uint8_t* darker) {
  const __m256i zero = _mm256_setzero_si256();
  const __m256i is_not_brighter = _mm256_cmpeq_epi8(bits_of(brighter), zero);
  const __m256i is_not_darker = _mm256_cmpeq_epi8(bits_of(darker), zero);
  return _mm256_avg_epu8(_mm256_xor_si256(is_not_brighter, _mm256_set1_epi8(-1)), is_not_darker);
}

void smooth_down_row(const DownRow& row) {
  const DownRow local = row;
  for (int x = 0; x < local.width; x += 4) {
    const int i = x * kPlaneCount;
    __m256i m = spread(local.brighter + x, local.darker + x);
    for (int pass = 0; pass < 3; ++pass) {
      const __m256i out = smooth(load(local.older[pass] + i), load(local.newer[pass] + i), m);
      store(local.older[pass] + i, m);
      m = out;
    }
    store(local.out + i, m);
  }
}

// One pass along the row, four pixels at a time.
struct AlongPass {
  __m256i here = _mm256_setzero_si256();    // pixels 4k … 4k + 3
  __m256i before = _mm256_setzero_si256();  // their left neighbours

  // Takes the next four pixels in and gives the smoothed ones before them.
  __m256i push(__m256i next) {
    const __m256i middle = _mm256_permute2x128_si256(here, next, 0x21);  // 4k + 2 … 4k + 5
    const __m256i after = _mm256_alignr_epi8(middle, here, kPlaneCount);
    const __m256i smoothed = smooth(before, here, after);
    before = _mm256_alignr_epi8(next, middle, kPlaneCount);
    here = next;
    return smoothed;
  }
};

// The three passes in one, each four pixels behind the one before: that is twelve. The last nine of
// them are read from beyond the margin and have no weight.
void smooth_along_row(const AlongRow& row) {
  const AlongRow local = row;
  AlongPass passes[3];
  const auto push = [&passes, &local](int x) {
    const __m256i in = load(local.in + x * kPlaneCount);
    return passes[2].push(passes[1].push(passes[0].push(in)));
  };
  for (int x = -4; x < 12; x += 4) push(x);
  int x = 0;
  for (; x + 4 <= local.width; x += 4) store(local.out + x * kPlaneCount, push(x + 12));
  if (x == local.width) return;
  store(local.spare, push(x + 12));
  __builtin_memcpy(local.out + x * kPlaneCount, local.spare,
                   static_cast<unsigned>(local.width - x) * kPlaneCount);
}

}  // namespace

void bit_planes_avx2(ImageView<const std::uint8_t> grey, int dead_zone,
                     ImageView<std::uint8_t> codes, std::span<std::uint8_t> scratch,
                     ImageView<std::uint8_t> planes) {
  bit_planes_by_rows(grey, dead_zone, codes, scratch, planes,
                     {blur_row, census_row, smooth_down_row, smooth_along_row});
}

}  // namespace darkling
