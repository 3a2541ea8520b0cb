// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/sample_residuals.h"

namespace darkling {
namespace {

constexpr int kHalf = kPointLanes / 2;  // a vector

// Eight warped points, an array a member so that each can be looked at alone.
struct Positions {
  std::int32_t u_q12[kPointLanes];
  std::int32_t v_q12[kPointLanes];
  std::uint32_t inside[kPointLanes];      // all bits, or none
  std::uint16_t weights[kPointLanes][4];  // bilinear: w00, w01, w10, w11
};

// Where the pixels end in which a point may lie.
struct Ends {
  float u;
  float v;
};

#if defined(__aarch64__)

// Row i of A · (x, y, f) + a · s.
float32x4_t transform(const PointWarp& warp, int i, float32x4_t x, float32x4_t y, float32x4_t s) {
  const float* A = warp.A + 3 * i;
  const float32x4_t Axy = vaddq_f32(vmulq_n_f32(x, A[0]), vmulq_n_f32(y, A[1]));
  const float32x4_t Axyf = vaddq_f32(Axy, vdupq_n_f32(A[2] * warp.focal_px));
  return vaddq_f32(Axyf, vmulq_n_f32(s, warp.a[i]));
}

float32x4_t to_pixel(float32x4_t ray, float32x4_t Z, float focal_px, float centre_px) {
  return vaddq_f32(vdivq_f32(vmulq_n_f32(ray, focal_px), Z), vdupq_n_f32(centre_px));
}

uint32x4_t is_between(float32x4_t pixel, float end) {
  return vandq_u32(vcgeq_f32(pixel, vdupq_n_f32(1.0f)), vcltq_f32(pixel, vdupq_n_f32(end)));
}

void warp_4(const TemplatePoints& points, int first, int k, const PointWarp& warp, const Ends& ends,
            Positions& out) {
  const float32x4_t x = vld1q_f32(points.x + first + k);
  const float32x4_t y = vld1q_f32(points.y + first + k);
  const float32x4_t s = vld1q_f32(points.inverse_depth_focal + first + k);
  const float32x4_t Z = transform(warp, 2, x, y, s);
  const float32x4_t u = to_pixel(transform(warp, 0, x, y, s), Z, warp.focal_px, warp.cx);
  const float32x4_t v = to_pixel(transform(warp, 1, x, y, s), Z, warp.focal_px, warp.cy);
  const uint32x4_t is_before = vcgtq_f32(Z, vdupq_n_f32(0.0f));
  const uint32x4_t is_inside = vandq_u32(is_between(u, ends.u), is_between(v, ends.v));
  vst1q_u32(out.inside + k, vandq_u32(is_before, is_inside));
  vst1q_s32(out.u_q12 + k, vcvtq_s32_f32(vmulq_n_f32(u, 4096.0f)));
  vst1q_s32(out.v_q12 + k, vcvtq_s32_f32(vmulq_n_f32(v, 4096.0f)));
}

#else

// The vectors of ARMv7 flush denormal numbers and cannot divide: a point at a time, as the
// reference.
void warp_4(const TemplatePoints& points, int first, int k, const PointWarp& warp, const Ends& ends,
            Positions& out) {
  for (const int end = k + kHalf; k < end; ++k) {
    const auto transform = [&](int row) {
      const float* A = warp.A + 3 * row;
      const float Axy = A[0] * points.x[first + k] + A[1] * points.y[first + k];
      return Axy + A[2] * warp.focal_px + warp.a[row] * points.inverse_depth_focal[first + k];
    };
    const float Z = transform(2);
    const float u = warp.focal_px * transform(0) / Z + warp.cx;
    const float v = warp.focal_px * transform(1) / Z + warp.cy;
    const bool is_inside = Z > 0.0f && u >= 1.0f && u < ends.u && v >= 1.0f && v < ends.v;
    out.inside[k] = is_inside ? ~0u : 0u;
    out.u_q12[k] = is_inside ? static_cast<std::int32_t>(u * 4096.0f) : 0;
    out.v_q12[k] = is_inside ? static_cast<std::int32_t>(v * 4096.0f) : 0;
  }
}

#endif

// Of the four points from `k`.
void put_weights(int k, Positions& at) {
  const uint32x4_t fraction = vdupq_n_u32(4095);
  const uint32x4_t fx = vandq_u32(vreinterpretq_u32_s32(vld1q_s32(at.u_q12 + k)), fraction);
  const uint32x4_t fy = vandq_u32(vreinterpretq_u32_s32(vld1q_s32(at.v_q12 + k)), fraction);
  const uint32x4_t w11 = vrshrq_n_u32(vmulq_u32(fx, fy), 10);
  const uint32x4_t fx4 = vshlq_n_u32(fx, 2);
  const uint32x4_t w10 = vsubq_u32(vshlq_n_u32(fy, 2), w11);
  const uint32x4_t w00 = vsubq_u32(vdupq_n_u32(16384), vaddq_u32(fx4, w10));
  const uint16x4x4_t weights = {
      {vmovn_u32(w00), vmovn_u32(vsubq_u32(fx4, w11)), vmovn_u32(w10), vmovn_u32(w11)}};
  vst4_u16(at.weights[k], weights);
}

// Four planes of the four pixels about a point, weighted, added and rounded to 1/64.
uint16x4_t blend(uint16x4_t p00, uint16x4_t p01, uint16x4_t p10, uint16x4_t p11, uint16x4_t w) {
  const uint32x4_t upper = vmlal_lane_u16(vmull_lane_u16(p00, w, 0), p01, w, 1);
  return vrshrn_n_u32(vmlal_lane_u16(vmlal_lane_u16(upper, p10, w, 2), p11, w, 3), 8);
}

// r_c of one point in 1/64.
int16x8_t residual(const std::uint8_t* at, std::ptrdiff_t stride, uint16x4_t w,
                   const PlanePatch& patch) {
  const uint16x8_t p00 = vmovl_u8(vld1_u8(at));
  const uint16x8_t p01 = vmovl_u8(vld1_u8(at + kPlaneCount));
  const uint16x8_t p10 = vmovl_u8(vld1_u8(at + stride));
  const uint16x8_t p11 = vmovl_u8(vld1_u8(at + stride + kPlaneCount));
  const uint16x8_t values = vcombine_u16(
      blend(vget_low_u16(p00), vget_low_u16(p01), vget_low_u16(p10), vget_low_u16(p11), w),
      blend(vget_high_u16(p00), vget_high_u16(p01), vget_high_u16(p10), vget_high_u16(p11), w));
  return vreinterpretq_s16_u16(vsubq_u16(values, vshll_n_u8(vld1_u8(patch.reference), 6)));
}

int32x4_t products(int16x8_t a, int16x8_t b) {
  return vmlal_s16(vmull_s16(vget_low_s16(a), vget_low_s16(b)), vget_high_s16(a), vget_high_s16(b));
}

// The three sums of eight points, each in four parts, as they come.
struct Sums {
  int32x4_t parts[3][kPointLanes];
};

void compare_point(const ImageView<const std::uint8_t>& planes, const Positions& at, int k,
                   const PlanePatch& patch, Sums& sums) {
  const std::uint8_t* upper =
      planes.data + (at.v_q12[k] >> 12) * planes.stride + (at.u_q12[k] >> 12) * kPlaneCount;
  const int16x8_t r = residual(upper, planes.stride, vld1_u16(at.weights[k]), patch);
  sums.parts[0][k] = products(r, vld1q_s16(patch.gx2));
  sums.parts[1][k] = products(r, vld1q_s16(patch.gy2));
  sums.parts[2][k] = products(r, r);
}

// Sums of neighbours, those of `a` first.
int32x4_t add_pairs(int32x4_t a, int32x4_t b) {
#if defined(__aarch64__)
  return vpaddq_s32(a, b);
#else
  return vcombine_s32(vpadd_s32(vget_low_s32(a), vget_high_s32(a)),
                      vpadd_s32(vget_low_s32(b), vget_high_s32(b)));
#endif
}

// Adds up the parts of eight points and writes them as floats, `outside` for those not inside.
// These floats are whole numbers times a power of two, never denormal: exact on ARMv7 too.
void put(float* to, const int32x4_t parts[kPointLanes], float unit, float outside,
         const std::uint32_t inside[kPointLanes]) {
  for (int k = 0; k < kPointLanes; k += kHalf) {
    const int32x4_t sums =
        add_pairs(add_pairs(parts[k], parts[k + 1]), add_pairs(parts[k + 2], parts[k + 3]));
    const float32x4_t values = vmulq_n_f32(vcvtq_f32_s32(sums), unit);
    vst1q_f32(to + k, vbslq_f32(vld1q_u32(inside + k), values, vdupq_n_f32(outside)));
  }
}

}  // namespace

int sample_residuals_neon(const TemplatePoints& points, const PointWarp& warp,
                          ImageView<const std::uint8_t> planes, const PointResiduals& out) {
  const int width = planes.width / kPlaneCount;
  const Ends ends = {static_cast<float>(width - 2), static_cast<float>(planes.height - 2)};
  int visible = 0;
  Sums sums = {};
  for (int first = 0; first < points.count; first += kPointLanes) {
    Positions at;
    for (int k = 0; k < kPointLanes; k += kHalf) {
      warp_4(points, first, k, warp, ends, at);
      put_weights(k, at);
    }
    for (int k = 0; k < kPointLanes; ++k) {
      if (first + k >= points.count) at.inside[k] = 0;
      if (at.inside[k] == 0) continue;
      compare_point(planes, at, k, points.patches[first + k], sums);
      ++visible;
    }
    put(out.bx + first, sums.parts[0], 1.0f / 128.0f, 0.0f, at.inside);
    put(out.by + first, sums.parts[1], 1.0f / 128.0f, 0.0f, at.inside);
    put(out.squares + first, sums.parts[2], 1.0f / 4096.0f, -1.0f, at.inside);
  }
  return visible;
}

}  // namespace darkling
