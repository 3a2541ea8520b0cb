// SPDX-License-Identifier: Apache-2.0
#include "vo/refine_window.h"

#include <algorithm>
#include <optional>

#include <Eigen/Cholesky>

#include "vo/align.h"

namespace darkling {

namespace {

constexpr int kRounds = 2;    // looks at the newest image
constexpr int kMaxSteps = 3;  // of a round; the second is mostly below a hundredth of a pixel
// Steps end when the cost falls by less than this share of it.
constexpr double kConvergedGain = 1e-4;
// As few as make a frame lost.
constexpr int kMinVisible = 30;
// Share of comparisons that agree below which the newest keyframe's pose is not believed. Of true
// ones 0.64 and more agree; of those 20 px off, somewhere else or with another image 0.15 at most.
constexpr double kMinAgreeing = 0.3;
// Tracking ends at a hundredth of a pixel of its own optimum; that of the window lies some tenths
// beside it. A keyframe that would move this far is wrong, or the others are.
constexpr double kMaxChangePx = 1.5;
// Of the normal equations with ones on the diagonal.
constexpr double kMinPivot = 1e-5;

using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxWindowUnknowns, 1>;
using SystemStride = Eigen::OuterStride<kMaxWindowUnknowns>;
using SystemMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                   kMaxWindowUnknowns, kMaxWindowUnknowns>;

// Compares the points of all other keyframes with the newest one's left image.
void observe_newest(const KernelTable& kernels, const PyramidLevel& left, Window& window) {
  const Se3 T_newest_world = window.newest().T_world_key.inverse();
  for (int h = 0; h + 1 < window.count; ++h) {
    WindowKeyframe& host = window.keyframes()[h];
    const TemplatePoints& points = host.points;
    WindowView& view = host.views[window.count - 2 - h];
    view.T_later_host = T_newest_world * host.T_world_key;
    std::copy_n(points.inverse_depth_focal, points.count, view.depth);
    view.visible_count = kernels.sample_residuals(points, make_warp(view.T_later_host, left),
                                                  left.planes, view.residuals);
    if (view.visible_count == 0) continue;
    view.inverse_scale =
        1.0f / weight_scale_squares(view.residuals, points.count, view.visible_count);
  }
}

// The step of all poses but the oldest's, or nothing where the equations do not determine it.
// @param H  in the memory of the equations: destroyed.
std::optional<Unknowns> solve(int count, WindowEquations& equations) {
  const int n = 6 * (count - 1);
  Eigen::Map<SystemMatrix, 0, SystemStride> H(equations.H.data() + 6 * kMaxWindowUnknowns + 6, n, n,
                                              SystemStride(kMaxWindowUnknowns));
  Unknowns scale(n);
  Unknowns g(n);
  for (int i = 0; i < n; ++i) {
    if (!(H(i, i) > 0.0)) return std::nullopt;
    scale[i] = 1.0 / std::sqrt(H(i, i));
    g[i] = scale[i] * equations.g[6 + i];
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) H(i, j) *= scale[i] * scale[j];
  }
  const Eigen::LDLT<Eigen::Ref<SystemMatrix, 0, SystemStride>> ldlt(H);
  if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > kMinPivot)) {
    return std::nullopt;
  }
  Unknowns step = -ldlt.solve(g);
  step.array() *= scale.array();
  if (!step.allFinite()) return std::nullopt;
  return step;
}

// Px of the image that a motion between keyframes is worth.
double size_px(const Vector6& xi, const Window& window, const WindowKeyframe& keyframe) {
  const int count = std::max(keyframe.points.count, 1);
  double depth = 0.0;
  for (int i = 0; i < keyframe.points.count; ++i) {
    depth += static_cast<double>(keyframe.points.inverse_depth_focal[i]);
  }
  return motion_px(xi, depth / count, window.focal_px);
}

void save(const Window& window, WindowEstimate& to) {
  for (int h = 0; h < window.count; ++h) {
    const WindowKeyframe& keyframe = window.keyframes()[h];
    to.T_world_key[h] = keyframe.T_world_key;
    std::copy_n(keyframe.points.inverse_depth_focal, keyframe.points.count, to.depth[h]);
  }
}

void restore(const WindowEstimate& from, Window& window) {
  for (int h = 0; h < window.count; ++h) {
    WindowKeyframe& keyframe = window.keyframes()[h];
    keyframe.T_world_key = from.T_world_key[h];
    std::copy_n(from.depth[h], keyframe.points.count, keyframe.points.inverse_depth_focal);
  }
}

void move(const Unknowns& step, const WindowEquations& equations, Window& window) {
  std::array<Vector6, kMaxWindowKeyframes> steps;
  steps[0].setZero();
  for (int h = 1; h < window.count; ++h) steps[h] = step.segment<6>(6 * (h - 1));
  for (int h = 0; h < window.count; ++h) {
    const TemplatePoints& points = window.keyframes()[h].points;
    const std::span<float> change(equations.residuals.bx, static_cast<std::size_t>(points.count));
    substitute_depths(window, equations, h, steps, change);
    for (int i = 0; i < points.count; ++i) {
      points.inverse_depth_focal[i] = std::max(points.inverse_depth_focal[i] + change[i], 0.0f);
    }
  }
  for (int h = 1; h < window.count; ++h) {
    Se3& T_world_key = window.keyframes()[h].T_world_key;
    T_world_key = T_world_key * Se3::exp(steps[h]);
  }
}

// The largest change since the start of a keyframe against the one before it.
double largest_change_px(const Window& window, const WindowEstimate& start) {
  double largest = 0.0;
  for (int h = 1; h < window.count; ++h) {
    const WindowKeyframe& keyframe = window.keyframes()[h];
    const Se3 T_before_key = start.T_world_key[h - 1].inverse() * start.T_world_key[h];
    const Se3 T_before_now = window.keyframes()[h - 1].T_world_key.inverse() * keyframe.T_world_key;
    largest = std::max(largest, size_px(minus(T_before_now, T_before_key), window, keyframe));
  }
  return largest;
}

Refinement judge_newest(const WindowEquations& equations) {
  if (equations.seen_in_newest < kMinVisible) return Refinement::kTooFewPoints;
  if (equations.agreeing_in_newest < kMinAgreeing * equations.seen_in_newest) {
    return Refinement::kDisagreement;
  }
  return Refinement::kApplied;
}

// What is known of each point after the last linearisation.
void keep_information(const WindowEquations& equations, Window& window) {
  for (int h = 0; h < window.count; ++h) {
    WindowKeyframe& keyframe = window.keyframes()[h];
    const DepthEquations& depths = equations.depths[h];
    for (int i = 0; i < keyframe.points.count; ++i) {
      keyframe.information[i] = 1.0f / depths.H[i];
      keyframe.inlier_ratio[i] = (1.0f + depths.agreeing[i]) / (2.0f + depths.compared[i]);
    }
  }
}

// What was refused is not to pull at later refinements either.
void forget_newest_views(Window& window) {
  for (int h = 0; h + 1 < window.count; ++h) {
    window.keyframes()[h].views[window.count - 2 - h].visible_count = 0;
  }
}

}  // namespace

Refinement descend_window(const KernelTable& kernels, WindowEquations& equations, Window& window) {
  Refinement outcome = Refinement::kNoGain;
  linearise_window(kernels, window, equations);
  if (const Refinement seen = judge_newest(equations); seen != Refinement::kApplied) return seen;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double cost = equations.cost;
    const std::optional<Unknowns> step = solve(window.count, equations);
    if (!step) return Refinement::kIllConditioned;
    save(window, equations.before_step);
    move(*step, equations, window);
    linearise_window(kernels, window, equations);
    if (!(equations.cost < cost)) {
      restore(equations.before_step, window);
      linearise_window(kernels, window, equations);
      break;
    }
    outcome = Refinement::kApplied;
    if (cost - equations.cost < kConvergedGain * cost) break;
  }
  return outcome;
}

Refinement refine_window(const KernelTable& kernels, const PyramidLevel& left,
                         WindowEquations& equations, Window& window) {
  save(window, equations.at_start);
  Refinement outcome = Refinement::kUnknown;
  for (int round = 0; round < kRounds; ++round) {
    observe_newest(kernels, left, window);
    const Refinement now = descend_window(kernels, equations, window);
    if (now == Refinement::kNoGain && round > 0) break;
    outcome = now;
    if (outcome != Refinement::kApplied) break;
  }
  if (outcome == Refinement::kApplied &&
      largest_change_px(window, equations.at_start) > kMaxChangePx) {
    outcome = Refinement::kStepTooLarge;
  }
  if (outcome == Refinement::kApplied) {
    keep_information(equations, window);
    return outcome;
  }
  restore(equations.at_start, window);
  if (outcome != Refinement::kNoGain) forget_newest_views(window);
  return outcome;
}

}  // namespace darkling
