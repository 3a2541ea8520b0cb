// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/bit_planes.h"
#include "kernels/saliency.h"

namespace darkling {
namespace {

constexpr int kPixels = 8;  // a step

// Sums of neighbours, those of `a` first.
uint16x8_t add_pairs(uint16x8_t a, uint16x8_t b) {
#if defined(__aarch64__)
  return vpaddq_u16(a, b);
#else
  return vcombine_u16(vpadd_u16(vget_low_u16(a), vget_high_u16(a)),
                      vpadd_u16(vget_low_u16(b), vget_high_u16(b)));
#endif
}

// Two pixels, the sum of each in four parts.
uint16x8_t sums_of_2(const std::uint8_t* here, std::ptrdiff_t stride) {
  const uint8x16_t along = vabdq_u8(vld1q_u8(here + kPlaneCount), vld1q_u8(here - kPlaneCount));
  const uint8x16_t down = vabdq_u8(vld1q_u8(here + stride), vld1q_u8(here - stride));
  return vpadalq_u8(vpaddlq_u8(along), down);
}

// Four pixels, the sum of each in two parts.
uint16x8_t sums_of_4(const std::uint8_t* here, std::ptrdiff_t stride) {
  return add_pairs(sums_of_2(here, stride), sums_of_2(here + 2 * kPlaneCount, stride));
}

void saliency_8(const std::uint8_t* here, std::ptrdiff_t stride, std::uint16_t* out) {
  vst1q_u16(out, add_pairs(sums_of_4(here, stride), sums_of_4(here + 4 * kPlaneCount, stride)));
}

}  // namespace

void saliency_neon(ImageView<const std::uint8_t> planes, ImageView<std::uint16_t> dst) {
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
