// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"
#include "kernels/bit_planes.h"

namespace darkling {

// Kernels that go over points take this many at a time; their arrays have room for a multiple of
// it.
inline constexpr int kPointLanes = 8;
[[nodiscard]] constexpr int round_up_to_lanes(int count) {
  return (count + kPointLanes - 1) / kPointLanes * kPointLanes;
}

// What the bit-planes are about one template point in the keyframe.
struct PlanePatch {
  std::uint8_t reference[kPlaneCount] = {};  // plane values
  std::int16_t gx2[kPlaneCount] = {};        // twice the gradient, φ(x+1) - φ(x-1)
  std::int16_t gy2[kPlaneCount] = {};
};

// The points of a keyframe's template at one pyramid level, an array a member.
struct TemplatePoints {
  int count = 0;
  float* x = nullptr;                    // px from the principal point
  float* y = nullptr;                    // px from the principal point
  float* inverse_depth_focal = nullptr;  // f / z = disparity / baseline, px/m
  float* Sxx = nullptr;  // Gram matrix of the plane gradients, Σ_c ∇φ_c ∇φ_cᵀ
  float* Sxy = nullptr;
  float* Syy = nullptr;
  PlanePatch* patches = nullptr;
};

// Where template points appear in the current frame, in disparity space: with s = f / z,
//   (X, Y, Z) = A · (x, y, f) + a · s,   u = f · X / Z + cx,   v = f · Y / Z + cy,
// A the rotation and a the translation of T_current_key, and f, cx, cy of the pyramid level.
struct PointWarp {
  float A[9] = {};  // row-major
  float a[3] = {};  // m
  float focal_px = 0.0f;
  float cx = 0.0f;
  float cy = 0.0f;
};

// What the points say about the motion, an array a member.
struct PointResiduals {
  float* bx = nullptr;       // Σ_c ∂xφ_c · r_c
  float* by = nullptr;       // Σ_c ∂yφ_c · r_c
  float* squares = nullptr;  // Σ_c r_c², at most 8 · 255²; < 0: the point is not in the image
};

// Compares every template point with the current frame: r_c = φ_c(u, v) - reference_c, bilinear.
// Points within one pixel of the border, or of a position that is no number, are not in the image.
//
// Fixed point, so that sums come out the same in any order: (u, v) is taken at 1/4096 px (floor),
// bilinear weights at 1/16384, r_c at 1/64 (rounded half up). An exact r_c differs by less than
// 1/64 for the weights and 1/128 for the rounding; Σ r_c² in 1/4096 fits 31 bits.
//
// @param planes  interleaved bit-planes of the current frame, 8 · w × h bytes; sides below 2^15.
// @param points, out  arrays of round_up_to_lanes(count); what stands behind the last point is
//                     read, and written as not in the image.
// @return how many points are in the image.
// Exactness: every variant equals the reference bit for bit.
// Cost: 64 bytes of template and 32 of the frame a point; two divisions.
using SampleResidualsFn = int(const TemplatePoints& points, const PointWarp& warp,
                              ImageView<const std::uint8_t> planes, const PointResiduals& out);

SampleResidualsFn sample_residuals_ref;
SampleResidualsFn sample_residuals_sse41;
SampleResidualsFn sample_residuals_avx2;
SampleResidualsFn sample_residuals_neon;

}  // namespace darkling
