// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/halve.h"

namespace darkling {
namespace {

constexpr int kPixels = 16;  // of the output, a step

uint8x8_t halve_8(const std::uint8_t* a, const std::uint8_t* b) {
  return vrshrn_n_u16(vpadalq_u8(vpaddlq_u8(vld1q_u8(a)), vld1q_u8(b)), 2);
}

void halve_16(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t* out) {
  vst1q_u8(out, vcombine_u8(halve_8(a, b), halve_8(a + kPixels, b + kPixels)));
}

}  // namespace

void halve_neon(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
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
