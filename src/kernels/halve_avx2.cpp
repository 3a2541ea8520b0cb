// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/halve.h"

namespace darkling {
namespace {

constexpr int kPixels = 16;  // of the output, a step

__m256i load(const std::uint8_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

void halve_16(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t* out) {
  const __m256i ones = _mm256_set1_epi8(1);
  const __m256i sum =
      _mm256_add_epi16(_mm256_maddubs_epi16(load(a), ones), _mm256_maddubs_epi16(load(b), ones));
  const __m256i mean = _mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16(2)), 2);
  const __m256i packed = _mm256_permute4x64_epi64(_mm256_packus_epi16(mean, mean), 0b00'00'10'00);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm256_castsi256_si128(packed));
}

}  // namespace

void halve_avx2(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
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
