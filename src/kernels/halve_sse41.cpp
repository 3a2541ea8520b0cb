// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/halve.h"

namespace darkling {
namespace {

constexpr int kPixels = 16;  // of the output, a step

__m128i load(const std::uint8_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

// Eight means, as 16-bit numbers.
__m128i halve_8(const std::uint8_t* a, const std::uint8_t* b) {
  const __m128i ones = _mm_set1_epi8(1);
  const __m128i sum =
      _mm_add_epi16(_mm_maddubs_epi16(load(a), ones), _mm_maddubs_epi16(load(b), ones));
  return _mm_srli_epi16(_mm_add_epi16(sum, _mm_set1_epi16(2)), 2);
}

void halve_16(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t* out) {
  const __m128i means = _mm_packus_epi16(halve_8(a, b), halve_8(a + kPixels, b + kPixels));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), means);
}

}  // namespace

void halve_sse41(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  if (dst.width < kPixels) {
    halve_ref(src, dst);
    return;
  }
  for (int y = 0; y < dst.height; ++y) {
    const std::uint8_t* a = src.data + 2 * y * src.stride;
    const std::uint8_t* b = a + src.stride;
    std::uint8_t* out = dst.data + y * dst.stride;
    for (int x = 0; x + kPixels <= dst.width; x += kPixels) {
      halve_16(a + 2 * x, b + 2 * x, out + x);
    }
    const int x = dst.width - kPixels;  // overlaps the one before: no read goes past the row
    halve_16(a + 2 * x, b + 2 * x, out + x);
  }
}

}  // namespace darkling
