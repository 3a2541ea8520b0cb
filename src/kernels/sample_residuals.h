// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/image_view.h"
#include "kernels/bit_planes.h"

namespace darkling {

// One point of a keyframe's template at one pyramid level: a cache line.
struct TemplatePoint {
  float x = 0.0f;                    // px from the principal point
  float y = 0.0f;                    // px from the principal point
  float inverse_depth_focal = 0.0f;  // f / z = disparity / baseline, px/m
  float Sxx = 0.0f;                  // Gram matrix of the plane gradients, Σ_c ∇φ_c ∇φ_cᵀ
  float Sxy = 0.0f;
  float Syy = 0.0f;
  std::array<std::uint8_t, kPlaneCount> reference = {};  // plane values in the keyframe
  std::array<std::int16_t, kPlaneCount> gx2 = {};        // twice the gradient, φ(x+1) - φ(x-1)
  std::array<std::int16_t, kPlaneCount> gy2 = {};
};
static_assert(sizeof(TemplatePoint) == 64);

// Where template points appear in the current frame, in disparity space: with s = f / z,
//   (X, Y, Z) = A · (x, y, f) + a · s,   u = f · X / Z + cx,   v = f · Y / Z + cy,
// A the rotation and a the translation of T_current_key, and f, cx, cy of the pyramid level.
struct PointWarp {
  std::array<float, 9> A = {};  // row-major
  std::array<float, 3> a = {};  // m
  float focal_px = 0.0f;
  float cx = 0.0f;
  float cy = 0.0f;
};

// What one point says about the motion.
struct PointResidual {
  float bx = 0.0f;         // Σ_c ∂xφ_c · r_c
  float by = 0.0f;         // Σ_c ∂yφ_c · r_c
  float distance = -1.0f;  // root mean square of r_c over the planes, 0…255; < 0: not in the image
};

// Compares every template point with the current frame: r_c = φ_c(u, v) - reference_c, bilinear.
//
// @param planes  interleaved bit-planes of the current frame, 8 · w × h bytes. Points within one
//                pixel of the border count as not in the image.
// @param out     one a point.
// @return how many points are in the image.
using SampleResidualsFn = int(std::span<const TemplatePoint> points, const PointWarp& warp,
                              ImageView<const std::uint8_t> planes, std::span<PointResidual> out);

SampleResidualsFn sample_residuals_ref;

}  // namespace darkling
