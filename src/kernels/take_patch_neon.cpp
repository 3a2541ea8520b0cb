// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/take_patch.h"

namespace darkling {
namespace {

// Differences of eight values, 16-bit.
int16x8_t difference(const std::uint8_t* a, const std::uint8_t* b) {
  return vreinterpretq_s16_u16(vsubl_u8(vld1_u8(a), vld1_u8(b)));
}

// Σ a b over the eight values.
std::int32_t dot(int16x8_t a, int16x8_t b) {
  const int32x4_t products =
      vmlal_s16(vmull_s16(vget_low_s16(a), vget_low_s16(b)), vget_high_s16(a), vget_high_s16(b));
  const int32x2_t halves = vadd_s32(vget_low_s32(products), vget_high_s32(products));
  return vget_lane_s32(vpadd_s32(halves, halves), 0);
}

}  // namespace

GramMatrix4 take_patch_neon(const std::uint8_t* planes, std::ptrdiff_t stride, PlanePatch& patch) {
  const int16x8_t gx2 = difference(planes + kPlaneCount, planes - kPlaneCount);
  const int16x8_t gy2 = difference(planes + stride, planes - stride);
  vst1_u8(patch.reference, vld1_u8(planes));
  vst1q_s16(patch.gx2, gx2);
  vst1q_s16(patch.gy2, gy2);
  return {dot(gx2, gx2), dot(gx2, gy2), dot(gy2, gy2)};
}

}  // namespace darkling
