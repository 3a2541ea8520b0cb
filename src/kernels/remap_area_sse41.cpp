// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/remap_area.h"
#include "kernels/remap_area_steps.h"

// Pixels less 128 are signed bytes, weights unsigned ones: so one instruction multiplies them and
// adds pairs, and the sum of a whole row, -128 · 256 at the least, just fits 16 bits. What the 128
// take away, 128 · 2^16 in the end, is added back with the rounding.

namespace darkling {
namespace {

std::int32_t read_4(const void* from) {
  std::int32_t four = 0;
  __builtin_memcpy(&four, from, sizeof(four));
  return four;
}

__m128i to_signed(__m128i pixels) {
  return _mm_xor_si128(pixels, _mm_set1_epi8(-128));
}

// One output pixel with at most four taps: its four weighted rows, one a quarter.
__m128i weigh_4x4(const RemapSource& s, const AreaMapEntry& e) {
  const std::uint8_t* p = s.pixels + e.y * s.stride + e.x;
  __m128i rows = _mm_cvtsi32_si128(read_4(p));
  rows = _mm_insert_epi32(rows, read_4(p + s.rows[1]), 1);
  rows = _mm_insert_epi32(rows, read_4(p + s.rows[2]), 2);
  rows = _mm_insert_epi32(rows, read_4(p + s.rows[3]), 3);
  const __m128i wx = _mm_set1_epi32(read_4(s.weights + e.phase_x * kMaxAreaTaps));
  const __m128i wy = _mm_cvtsi32_si128(read_4(s.weights + e.phase_y * kMaxAreaTaps));
  const __m128i twice_each = _mm_setr_epi8(0, -1, 0, -1, 1, -1, 1, -1, 2, -1, 2, -1, 3, -1, 3, -1);
  const __m128i along = _mm_maddubs_epi16(wx, to_signed(rows));
  return _mm_madd_epi16(along, _mm_shuffle_epi8(wy, twice_each));
}

__m128i load_8(const std::uint8_t* from) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
}

// Two rows of eight pixels, weighted along the row: four 16-bit sums of each.
__m128i weigh_rows(const std::uint8_t* upper, const std::uint8_t* lower, __m128i weights_twice) {
  return _mm_maddubs_epi16(weights_twice,
                           to_signed(_mm_unpacklo_epi64(load_8(upper), load_8(lower))));
}

// The weights of rows j and j + 1, four times each, as 16-bit numbers.
__m128i row_weights(const std::uint8_t* wy, int j) {
  const __m128i four_each = _mm_setr_epi8(0, -1, 0, -1, 0, -1, 0, -1, 1, -1, 1, -1, 1, -1, 1, -1);
  return _mm_shuffle_epi8(_mm_cvtsi32_si128(wy[j] | wy[j + 1] << 8), four_each);
}

// One output pixel with five to eight taps, the sums of its box in four parts. Reads eight columns.
__m128i weigh_8x8(const RemapSource& s, const AreaMapEntry& e) {
  const __m128i w = load_8(s.weights + e.phase_x * kMaxAreaTaps);
  const __m128i along = _mm_unpacklo_epi64(w, w);
  const std::uint8_t* wy = s.weights + e.phase_y * kMaxAreaTaps;
  const std::uint8_t* p = s.pixels + e.y * s.stride + e.x;
  const auto pair = [&](int j) {
    return _mm_madd_epi16(weigh_rows(p + s.rows[j], p + s.rows[j + 1], along), row_weights(wy, j));
  };
  const __m128i sum = _mm_add_epi32(_mm_add_epi32(pair(0), pair(2)), pair(4));
  return s.taps <= 6 ? sum : _mm_add_epi32(sum, pair(6));
}

// One output pixel with any number of taps. Reads whole groups of eight columns.
__m128i weigh_wide(const RemapSource& s, const AreaMapEntry& e) {
  const std::uint8_t* wx = s.weights + e.phase_x * kMaxAreaTaps;
  const std::uint8_t* wy = s.weights + e.phase_y * kMaxAreaTaps;
  const std::uint8_t* p = s.pixels + e.y * s.stride + e.x;
  __m128i sum = _mm_setzero_si128();
  for (int j = 0; j < s.taps; j += 2) {
    const std::uint8_t* upper = p + j * s.stride;
    // A row beyond the last has no weight, and may lie outside.
    const std::uint8_t* lower = j + 1 < s.taps ? upper + s.stride : upper;
    __m128i along = _mm_setzero_si128();
    for (int i = 0; i < s.taps; i += 8) {
      const __m128i w = load_8(wx + i);
      along = _mm_add_epi16(along, weigh_rows(upper + i, lower + i, _mm_unpacklo_epi64(w, w)));
    }
    sum = _mm_add_epi32(sum, _mm_madd_epi16(along, row_weights(wy, j)));
  }
  return sum;
}

__m128i weigh(const RemapSource& s, const AreaMapEntry& e) {
  return s.taps <= 4 ? weigh_4x4(s, e) : s.taps <= 8 ? weigh_8x8(s, e) : weigh_wide(s, e);
}

// Four output pixels, rounded, as 32-bit numbers.
__m128i remap_4(const RemapSource& s, const AreaMapEntry* e) {
  const __m128i sums = _mm_hadd_epi32(_mm_hadd_epi32(weigh(s, e[0]), weigh(s, e[1])),
                                      _mm_hadd_epi32(weigh(s, e[2]), weigh(s, e[3])));
  const __m128i offset = _mm_set1_epi32((128 << 16) + (1 << 15));
  return _mm_srli_epi32(_mm_add_epi32(sums, offset), 16);
}

void remap_8(const RemapSource& s, const AreaMapEntry* e, std::uint8_t* out) {
  const __m128i words = _mm_packus_epi32(remap_4(s, e), remap_4(s, e + 4));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_packus_epi16(words, words));
}

}  // namespace

void remap_area_sse41(const AreaMap& map, ImageView<const std::uint8_t> src,
                      ImageView<std::uint8_t> dst) {
  remap_area_by_eights(map, src, dst, remap_8);
}

}  // namespace darkling
