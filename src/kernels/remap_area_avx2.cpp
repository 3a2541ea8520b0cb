// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

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

// The four columns and rows of pixels under the box of one output pixel: a row each quarter.
__m128i load_4x4(const RemapSource& s, const AreaMapEntry& e) {
  const std::uint8_t* p = s.pixels + e.y * s.stride + e.x;
  __m128i rows = _mm_cvtsi32_si128(read_4(p));
  rows = _mm_insert_epi32(rows, read_4(p + s.rows[1]), 1);
  rows = _mm_insert_epi32(rows, read_4(p + s.rows[2]), 2);
  return to_signed(_mm_insert_epi32(rows, read_4(p + s.rows[3]), 3));
}

// Two output pixels with at most four taps: the four weighted rows of each, one a quarter.
__m256i weigh_4x4(const RemapSource& s, const AreaMapEntry& a, const AreaMapEntry& b) {
  const __m256i pixels = _mm256_set_m128i(load_4x4(s, b), load_4x4(s, a));
  const auto weights = [&s](int phase_a, int phase_b) {
    return _mm256_set_m128i(_mm_set1_epi32(read_4(s.weights + phase_b * kMaxAreaTaps)),
                            _mm_set1_epi32(read_4(s.weights + phase_a * kMaxAreaTaps)));
  };
  const __m256i along = _mm256_maddubs_epi16(weights(a.phase_x, b.phase_x), pixels);
  const __m256i twice_each = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(0, -1, 0, -1, 1, -1, 1, -1, 2, -1, 2, -1, 3, -1, 3, -1));
  const __m256i down = _mm256_shuffle_epi8(weights(a.phase_y, b.phase_y), twice_each);
  return _mm256_madd_epi16(along, down);
}

// Adds up the quarters of eight pixels, given as (0, 4), (1, 5), (2, 6), (3, 7), and rounds.
void finish_8(const __m256i pairs[4], std::uint8_t* out) {
  const __m256i sums = _mm256_hadd_epi32(_mm256_hadd_epi32(pairs[0], pairs[1]),
                                         _mm256_hadd_epi32(pairs[2], pairs[3]));
  const __m256i offset = _mm256_set1_epi32((128 << 16) + (1 << 15));
  const __m256i grey = _mm256_srli_epi32(_mm256_add_epi32(sums, offset), 16);
  const __m128i words =
      _mm_packus_epi32(_mm256_castsi256_si128(grey), _mm256_extracti128_si256(grey, 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_packus_epi16(words, words));
}

void remap_8(const RemapSource& s, const AreaMapEntry* e, std::uint8_t* out) {
  __m256i pairs[4];
  for (int i = 0; i < 4; ++i) pairs[i] = weigh_4x4(s, e[i], e[i + 4]);
  finish_8(pairs, out);
}

}  // namespace

void remap_area_avx2(const AreaMap& map, ImageView<const std::uint8_t> src,
                     ImageView<std::uint8_t> dst) {
  // Wider boxes gain nothing from a second pixel in the vector.
  if (map.taps > 4) {
    remap_area_sse41(map, src, dst);
  } else {
    remap_area_by_eights(map, src, dst, remap_8);
  }
}

}  // namespace darkling
