// SPDX-License-Identifier: Apache-2.0
// The least squares problem of the window, one linearisation of it.
//
// Unknowns: a right perturbation ξ_j = (ρ, θ) of each keyframe's T_world_key but the oldest's, and
// an inverse depth s_i of each point. A point of host h was compared with keyframe j at T⁰ and s⁰,
// and a residual r_c⁰ was found in each plane. At other poses and depths
//
//   r_c = r_c⁰ + ∇φ_c δ,   δ = J η + J_s (s - s⁰),   η = log(T⁰⁻¹ T_j_h),
//
// with J the derivative of the host's pixel by a motion of the point (kernels/normal_equations.h),
// τ = R_j_hᵀ t_j_h and k = Z_j / Z_h = 1 + τ_z s / f:
//
//   J_s = (τ_x - x τ_z / f,  τ_y - y τ_z / f)ᵀ / k,        η changes by ξ_h - Ad(T_h_j) ξ_j.
//
// What is minimised is Σ e / (1 + e), e = Σ_c r_c² / (8 σ²) (Geman and McClure), with a scale σ for
// each view from its median residual; and for each point's own stereo disparity the same with
// e = (b (s - s_stereo))² / (8 var).
//
// Source: Alismail, Browning, Lucey, "Photometric bundle adjustment for vision-based SLAM", 2016;
// Engel, Koltun, Cremers, "Direct sparse odometry", 2018, for the window and its elimination of
// depths.
#pragma once

#include <array>
#include <span>

#include "base/arena.h"
#include "geometry/se3.h"
#include "kernels/kernel_table.h"
#include "vo/window.h"

namespace darkling {

inline constexpr int kMaxWindowUnknowns = 6 * kMaxWindowKeyframes;

// An estimate of the window to go back to.
struct WindowEstimate {
  std::array<Se3, kMaxWindowKeyframes> T_world_key;
  std::array<float*, kMaxWindowKeyframes> depth = {};  // of each keyframe's points
};

// Of one host's points, an array a member: what eliminating their depths needs.
struct DepthEquations {
  float* H = nullptr;  // of the depth; its inverse after elimination
  float* g = nullptr;
  float* agreeing = nullptr;  // comparisons that agree on an absolute scale, and …
  float* compared = nullptr;  // … all
  // H of depth and the motion η against each later keyframe: [keyframes later - 1][component]
  std::array<std::array<float*, 6>, kMaxWindowKeyframes - 1> C = {};
};

// Scratch and result of one linearisation.
struct WindowEquations {
  std::array<DepthEquations, kMaxWindowKeyframes> depths;  // of each host
  PointResiduals residuals;                                // of one view, at the present estimate
  float* cost_terms = nullptr;
  WindowEstimate at_start;
  WindowEstimate before_step;
  // Of the keyframes' poses, depths eliminated: kMaxWindowUnknowns² row by row.
  std::span<double> H;
  std::array<double, kMaxWindowUnknowns> g = {};
  double cost = 0.0;
  int seen_in_newest = 0;      // comparisons in the newest keyframe, and …
  int agreeing_in_newest = 0;  // … those that agree on an absolute scale
};

// @param equations  new.
void allocate_window_equations(const OdometryConfig& config, Arena& arena,
                               WindowEquations& equations);

// Linearises the whole window at its present estimate.
void linearise_window(const KernelTable& kernels, const Window& window, WindowEquations& equations);

// The change of a host's depths that goes with the poses' step.
// @param steps  ξ of each keyframe.
// @param out    a number a point.
void substitute_depths(const Window& window, const WindowEquations& equations, int host,
                       std::span<const Vector6> steps, std::span<float> out);

}  // namespace darkling
