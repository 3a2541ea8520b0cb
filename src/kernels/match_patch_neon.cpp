// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/bit_planes.h"
#include "kernels/match_patch.h"

namespace darkling {
namespace {

constexpr int kCodeRows = 2 * kCodePatchRadius + 1;
constexpr int kRowPairs = (kCodeRows + 1) / 2;

// Seven rows of eight codes, two a vector; the eighth row is 0.
struct CodePatch {
  uint8x16_t pairs[kRowPairs];
};

CodePatch load_codes(const std::uint8_t* corner, std::ptrdiff_t stride) {
  CodePatch patch;
  for (int j = 0; j < kRowPairs; ++j) {
    const std::uint8_t* row = corner + 2 * j * stride;
    const uint8x8_t lower = 2 * j + 1 < kCodeRows ? vld1_u8(row + stride) : vdup_n_u8(0);
    patch.pairs[j] = vcombine_u8(vld1_u8(row), lower);
  }
  return patch;
}

// How many bits differ, the eighth code of the rows left out.
int count_different(const CodePatch& a, const CodePatch& b) {
  uint8x16_t sum = vdupq_n_u8(0);  // a byte counts to 32 at most
  for (int j = 0; j < kRowPairs; ++j) {
    sum = vaddq_u8(sum, vcntq_u8(veorq_u8(a.pairs[j], b.pairs[j])));
  }
  const uint8x8_t seven = vcreate_u8(0x00ff'ffff'ffff'ffffULL);
  const uint8x8_t columns = vand_u8(vadd_u8(vget_low_u8(sum), vget_high_u8(sum)), seven);
  const uint32x2_t halves = vpaddl_u16(vpaddl_u8(columns));
  return static_cast<int>(vget_lane_u32(vpadd_u32(halves, halves), 0));
}

// One pixel's right values between two pixels, less the left ones, in 1/16.
int16x8_t residual(const std::uint8_t* left, const std::uint8_t* right, int fraction_q12) {
  const auto weight = static_cast<std::uint16_t>(4096 - fraction_q12);
  const auto next_weight = static_cast<std::uint16_t>(fraction_q12);
  const auto value = [=](uint16x4_t here, uint16x4_t next) {
    return vrshrn_n_u32(vmlal_n_u16(vmull_n_u16(here, weight), next, next_weight), 8);
  };
  const uint16x8_t here = vmovl_u8(vld1_u8(right));
  const uint16x8_t next = vmovl_u8(vld1_u8(right + kPlaneCount));
  const uint16x8_t values = vcombine_u16(value(vget_low_u16(here), vget_low_u16(next)),
                                         value(vget_high_u16(here), vget_high_u16(next)));
  return vreinterpretq_s16_u16(vsubq_u16(values, vshll_n_u8(vld1_u8(left), 4)));
}

int16x8_t gradient(const std::uint8_t* left) {
  return vreinterpretq_s16_u16(vsubl_u8(vld1_u8(left + kPlaneCount), vld1_u8(left - kPlaneCount)));
}

int32x4_t add_products(int32x4_t sum, int16x8_t a, int16x8_t b) {
  return vmlal_s16(vmlal_s16(sum, vget_low_s16(a), vget_low_s16(b)), vget_high_s16(a),
                   vget_high_s16(b));
}

std::int32_t add_up(int32x4_t four) {
  const int32x2_t two = vadd_s32(vget_low_s32(four), vget_high_s32(four));
  return vget_lane_s32(vpadd_s32(two, two), 0);
}

}  // namespace

void match_codes_neon(const std::uint8_t* left, std::ptrdiff_t left_stride,
                      const std::uint8_t* right, std::ptrdiff_t right_stride, int count,
                      int* cost) {
  const CodePatch patch =
      load_codes(left - kCodePatchRadius * left_stride - kCodePatchRadius, left_stride);
  const std::uint8_t* corner = right - kCodePatchRadius * right_stride - kCodePatchRadius;
  for (int k = 0; k < count; ++k) {
    cost[k] = count_different(patch, load_codes(corner - k, right_stride));
  }
}

PatchFit compare_patch_neon(const std::uint8_t* left, std::ptrdiff_t left_stride,
                            const std::uint8_t* right, std::ptrdiff_t right_stride,
                            int fraction_q12) {
  int32x4_t gr = vdupq_n_s32(0);
  int32x4_t gg = gr;
  int32x4_t rr = gr;
  for (int j = -kPlanePatchRadius; j <= kPlanePatchRadius; ++j) {
    for (int i = -kPlanePatchRadius; i <= kPlanePatchRadius; ++i) {
      const std::uint8_t* l = left + j * left_stride + i * kPlaneCount;
      const int16x8_t r = residual(l, right + j * right_stride + i * kPlaneCount, fraction_q12);
      const int16x8_t g = gradient(l);
      gr = add_products(gr, g, r);
      gg = add_products(gg, g, g);
      rr = add_products(rr, r, r);
    }
  }
  return {add_up(gr), add_up(gg), add_up(rr)};
}

}  // namespace darkling
