// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/bit_planes.h"
#include "kernels/saliency.h"

namespace darkling {
namespace {

constexpr int kPixels = 8;  // a step; a sum of absolute differences adds up just one pixel

__m128i difference(const std::uint8_t* a, const std::uint8_t* b) {
  return _mm_sad_epu8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a)),
                      _mm_loadu_si128(reinterpret_cast<const __m128i*>(b)));
}

// Two pixels, their sums in the lowest 16 bits of each half.
__m128i sums_of_2(const std::uint8_t* here, std::ptrdiff_t stride) {
  return _mm_add_epi64(difference(here + kPlaneCount, here - kPlaneCount),
                       difference(here + stride, here - stride));
}

// Four pixels, their sums in the lowest 16 bits of each quarter.
__m128i sums_of_4(const std::uint8_t* here, std::ptrdiff_t stride) {
  return _mm_packus_epi32(sums_of_2(here, stride), sums_of_2(here + 2 * kPlaneCount, stride));
}

void saliency_8(const std::uint8_t* here, std::ptrdiff_t stride, std::uint16_t* out) {
  const __m128i sums =
      _mm_packus_epi32(sums_of_4(here, stride), sums_of_4(here + 4 * kPlaneCount, stride));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), sums);
}

}  // namespace

void saliency_sse41(ImageView<const std::uint8_t> planes, ImageView<std::uint16_t> dst) {
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
    const auto step = [&](int x) { saliency_8(here + x * kPlaneCount, planes.stride, out + x); };
    for (int x = 1; x + kPixels <= last; x += kPixels) step(x);
    step(last - kPixels);  // overlaps the one before: no read goes past the row
    out[0] = 0;
    out[last] = 0;
  }
}

}  // namespace darkling
