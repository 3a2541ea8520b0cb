// SPDX-License-Identifier: Apache-2.0
#include "support/window_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace darkling::test {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// The motion of the host's pixel, px, that stands for a change of the pose and of the depth.
Vector2d pixel_motion(const Window& window, const Comparison& at, const Se3& T_later_host,
                      double depth) {
  const WindowKeyframe& host = window.keyframes()[at.host];
  const WindowView& view = host.views[at.later - at.host - 1];
  const double f = window.focal_px;
  const Vector3 ray(host.points.x[at.point], host.points.y[at.point], f);
  Eigen::Matrix<double, 2, 3> project;  // of a motion of the ray's end, at depth f
  project << 1.0, 0.0, -ray.x() / f, 0.0, 1.0, -ray.y() / f;
  const Vector6 eta = (view.T_later_host.inverse() * T_later_host).log();
  const Vector3 moved = depth * eta.head<3>() + eta.tail<3>().cross(ray);
  const Vector3 tau = T_later_host.rotation().conjugate() * T_later_host.translation();
  const double k = 1.0 + tau.z() * depth / f;
  return project * (moved + (depth - double(view.depth[at.point])) / k * tau);
}

}  // namespace

WindowState state_of(const Window& window) {
  WindowState state;
  for (const WindowKeyframe& keyframe : window.keyframes()) {
    state.T_world_key.push_back(keyframe.T_world_key);
    const float* depths = keyframe.points.inverse_depth_focal;
    state.depths.insert(state.depths.end(), depths, depths + keyframe.points.count);
  }
  return state;
}

std::vector<Comparison> comparisons_of(const Window& window) {
  std::vector<Comparison> comparisons;
  int first_depth = 0;
  for (int h = 0; h < window.count; ++h) {
    const WindowKeyframe& host = window.keyframes()[h];
    for (int i = 0; i < host.points.count; ++i) {
      comparisons.push_back({h, -1, i, first_depth + i});
      for (int j = h + 1; j < window.count; ++j) {
        const WindowView& view = host.views[j - h - 1];
        if (view.visible_count > 0 && view.residuals.squares[i] >= 0.0f) {
          comparisons.push_back({h, j, i, first_depth + i});
        }
      }
    }
    first_depth += host.points.count;
  }
  return comparisons;
}

Vector3 residual(const Window& window, const Comparison& at, const Se3& T_world_host,
                 const Se3& T_world_later, double depth) {
  const WindowKeyframe& host = window.keyframes()[at.host];
  const int i = at.point;
  if (at.later < 0) {
    return {std::sqrt(double(host.stereo_information[i])) * (depth - double(host.stereo_depth[i])),
            0.0, 0.0};
  }
  const WindowView& view = host.views[at.later - at.host - 1];
  const Vector2d delta = pixel_motion(window, at, T_world_later.inverse() * T_world_host, depth);
  // |r⁰ + ∇φ δ|² = δᵀSδ + 2 b⁰ᵀδ + squares, with S = V Λ Vᵀ: along each axis a square completed.
  Matrix2d S;
  S << host.points.Sxx[i], host.points.Sxy[i], host.points.Sxy[i], host.points.Syy[i];
  const Eigen::SelfAdjointEigenSolver<Matrix2d> axes(S);
  const Vector2d b =
      axes.eigenvectors().transpose() * Vector2d(view.residuals.bx[i], view.residuals.by[i]);
  const Vector2d along = axes.eigenvectors().transpose() * delta;
  Vector3 r(0.0, 0.0, view.residuals.squares[i]);
  for (int axis = 0; axis < 2; ++axis) {
    const double length = std::sqrt(std::max(axes.eigenvalues()[axis], 0.0));
    if (length < 1e-3) continue;  // no gradient that way, and no part of b
    r[axis] = length * along[axis] + b[axis] / length;
    r.z() -= b[axis] * b[axis] / (length * length);
  }
  r.z() = std::sqrt(std::max(r.z(), 0.0));
  return std::sqrt(double(view.inverse_scale)) * r;
}

double cost_of(const Window& window, const WindowState& state) {
  double cost = 0.0;
  for (const Comparison& at : comparisons_of(window)) {
    const double e = residual(window, at, state.T_world_key[at.host],
                              state.T_world_key[std::max(at.later, 0)], state.depths[at.depth])
                         .squaredNorm();
    cost += e / (1.0 + e);
  }
  return cost;
}

}  // namespace darkling::test
