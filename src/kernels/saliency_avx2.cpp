// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/bit_planes.h"
#include "kernels/saliency.h"

namespace darkling {
namespace {

constexpr int kPixels = 4;  // a vector; a sum of absolute differences adds up just one pixel

__m256i difference(const std::uint8_t* a, const std::uint8_t* b) {
  return _mm256_sad_epu8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(a)),
                         _mm256_loadu_si256(reinterpret_cast<const __m256i*>(b)));
}

// Pixels x … x + 3, their sums in the lowest 16 bits of each quarter.
__m256i sums_at(const std::uint8_t* here, std::ptrdiff_t stride) {
  return _mm256_add_epi64(difference(here + kPlaneCount, here - kPlaneCount),
                          difference(here + stride, here - stride));
}

void saliency_4(const std::uint8_t* here, std::ptrdiff_t stride, std::uint16_t* out) {
  const __m256i sums = sums_at(here, stride);
  const __m128i pairs = _mm_packus_epi32(_mm256_castsi256_si128(sums),
                                         _mm256_extracti128_si256(sums, 1));  // s0 0 s1 0 s2 0 s3 0
  const __m128i order = _mm_setr_epi8(0, 1, 4, 5, 8, 9, 12, 13, -1, -1, -1, -1, -1, -1, -1, -1);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(pairs, order));
}

}  // namespace

void saliency_avx2(ImageView<const std::uint8_t> planes, ImageView<std::uint16_t> dst) {
  const int last = dst.width - 1;
  if (last - 1 < kPixels || dst.height < 3) {
    saliency_ref(planes, dst);
    return;
  }
  const auto clear = [&dst](int y) {
    for (int x = 0; x < dst.width; ++x) dst.data[y * dst.stride + x] = 0;
  };
  clear(0);
  clear(dst.height - 1);
  for (int y = 1; y < dst.height - 1; ++y) {
    const std::uint8_t* here = planes.data + y * planes.stride;
    std::uint16_t* out = dst.data + y * dst.stride;
    const auto step = [&](int x) { saliency_4(here + x * kPlaneCount, planes.stride, out + x); };
    for (int x = 1; x + kPixels <= last; x += kPixels) step(x);
    step(last - kPixels);  // overlaps the one before: no read goes past the row
    out[0] = 0;
    out[last] = 0;
  }
}

}  // namespace darkling
