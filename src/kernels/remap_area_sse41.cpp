// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/remap_area.h"

// Pixels less 128 are signed bytes, weights unsigned ones: so one instruction multiplies them and
// adds pairs, and the sum of a whole row, -128 · 256 at the least, just fits 16 bits. What the 128
// take away, 128 · 2^16 in the end, is added back with the rounding.

namespace darkling {
namespace {

constexpr int kPixels = 8;  // of the output, a step

std::int32_t read_4(const void* from) {
  std::int32_t four = 0;
  __builtin_memcpy(&four, from, sizeof(four));
  return four;
}

// The source of one image.
struct Source {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride;
  const std::uint8_t* weights;
  int taps;
  // Where the first four rows of a box begin. Rows beyond `taps` have no weight but may lie outside
  // the image, so the last row stands in.
  std::ptrdiff_t rows[4];
};

Source make_source(const AreaMap& map, const ImageView<const std::uint8_t>& src) {
  Source source = {src.data, src.stride, map.weights, map.taps, {}};
  for (int j = 0; j < 4; ++j) source.rows[j] = (j < map.taps ? j : map.taps - 1) * src.stride;
  return source;
}

__m128i to_signed(__m128i pixels) {
  return _mm_xor_si128(pixels, _mm_set1_epi8(-128));
}

// One output pixel with at most four taps: its four weighted rows, one a quarter.
__m128i weigh_4x4(const Source& s, const AreaMapEntry& e) {
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

// One output pixel with any number of taps, the sums of its box in four parts. Reads whole groups
// of eight columns.
__m128i weigh_wide(const Source& s, const AreaMapEntry& e) {
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
      const __m128i first = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(upper + i));
      const __m128i second = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(lower + i));
      const __m128i w = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(wx + i));
      along = _mm_add_epi16(along, _mm_maddubs_epi16(_mm_unpacklo_epi64(w, w),
                                                     to_signed(_mm_unpacklo_epi64(first, second))));
    }
    const __m128i four_each = _mm_setr_epi8(0, -1, 0, -1, 0, -1, 0, -1, 1, -1, 1, -1, 1, -1, 1, -1);
    const __m128i down = _mm_shuffle_epi8(_mm_cvtsi32_si128(wy[j] | wy[j + 1] << 8), four_each);
    sum = _mm_add_epi32(sum, _mm_madd_epi16(along, down));
  }
  return sum;
}

__m128i weigh(const Source& s, const AreaMapEntry& e) {
  return s.taps <= 4 ? weigh_4x4(s, e) : weigh_wide(s, e);
}

// Four output pixels, rounded, as 32-bit numbers.
__m128i remap_4(const Source& s, const AreaMapEntry* e) {
  const __m128i sums = _mm_hadd_epi32(_mm_hadd_epi32(weigh(s, e[0]), weigh(s, e[1])),
                                      _mm_hadd_epi32(weigh(s, e[2]), weigh(s, e[3])));
  const __m128i offset = _mm_set1_epi32((128 << 16) + (1 << 15));
  return _mm_srli_epi32(_mm_add_epi32(sums, offset), 16);
}

void remap_8(const Source& s, const AreaMapEntry* e, std::uint8_t* out) {
  const __m128i words = _mm_packus_epi32(remap_4(s, e), remap_4(s, e + 4));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_packus_epi16(words, words));
}

}  // namespace

void remap_area_sse41(const AreaMap& map, ImageView<const std::uint8_t> src,
                      ImageView<std::uint8_t> dst) {
  const Source source = make_source(map, src);
  const int columns_read = map.taps <= 4 ? 4 : (map.taps + 7) / 8 * 8;
  const int last_x = src.width - columns_read;
  for (int v = 0; v < dst.height; ++v) {
    const AreaMapEntry* entries = map.entries.data + v * map.entries.stride;
    std::uint8_t* out = dst.data + v * dst.stride;
    int u = 0;
    for (; u + kPixels <= dst.width; u += kPixels) {
      bool is_inside = true;
      for (int i = 0; i < kPixels; ++i) is_inside = is_inside && entries[u + i].x <= last_x;
      if (is_inside) {
        remap_8(source, entries + u, out + u);
        continue;
      }
      for (int i = u; i < u + kPixels; ++i) {
        out[i] = remap_area_pixel(map, entries[i], src.data, src.stride);
      }
    }
    for (; u < dst.width; ++u) {
      out[u] = remap_area_pixel(map, entries[u], src.data, src.stride);
    }
  }
}

}  // namespace darkling
