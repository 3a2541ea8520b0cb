// SPDX-License-Identifier: Apache-2.0
// One linearisation of the window as a single dense system of all poses and all depths.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "support/numeric_jacobian.h"
#include "support/window_model.h"
#include "vo/window_equations.h"

namespace darkling::test {

struct DenseSystem {
  Eigen::MatrixXd H;  // of 6 numbers a pose, then the depths
  Eigen::VectorXd g;
  int pose_count = 0;  // numbers, not poses
  [[nodiscard]] auto poses() const { return H.topLeftCorner(pose_count, pose_count); }
  [[nodiscard]] auto mixed() const { return H.topRightCorner(pose_count, depth_count()); }
  [[nodiscard]] auto depths() const { return H.bottomRightCorner(depth_count(), depth_count()); }
  [[nodiscard]] int depth_count() const { return static_cast<int>(g.size()) - pose_count; }
};

inline DenseSystem zero_system(int keyframes, int depths) {
  const int size = 6 * keyframes + depths;
  return {Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 6 * keyframes};
}

// From numeric derivatives of the model's residuals, with the weights of the present estimate.
inline DenseSystem model_system(const Window& window) {
  const WindowState state = state_of(window);
  DenseSystem system = zero_system(window.count, static_cast<int>(state.depths.size()));
  for (const Comparison& at : comparisons_of(window)) {
    const int later = std::max(at.later, 0);
    using Unknowns = Eigen::Matrix<double, 13, 1>;  // of the host, of the later one, the depth
    const auto r = [&](const Unknowns& x) {
      return residual(window, at, plus(state.T_world_key[at.host], x.head<6>()),
                      plus(state.T_world_key[later], x.segment<6>(6)),
                      state.depths[at.depth] + x[12]);
    };
    const Vector3 r_here = r(Unknowns::Zero());
    const auto J = numeric_jacobian<3, 13>(r, Unknowns(Unknowns::Zero()));
    const double d = 1.0 / (1.0 + r_here.squaredNorm());
    Eigen::VectorXi places(13);
    for (int k = 0; k < 6; ++k) places[k] = 6 * at.host + k;
    for (int k = 0; k < 6; ++k) places[6 + k] = 6 * later + k;
    places[12] = system.pose_count + at.depth;
    const Eigen::Matrix<double, 13, 13> H = d * d * J.transpose() * J;
    for (int a = 0; a < 13; ++a) {
      system.g[places[a]] += d * d * J.col(a).dot(r_here);
      for (int b = 0; b < 13; ++b) system.H(places[a], places[b]) += H(a, b);
    }
  }
  return system;
}

// From the product's equations, by undoing the elimination of the depths.
inline DenseSystem product_system(const Window& window, const WindowEquations& equations) {
  int depths = 0;
  for (const WindowKeyframe& keyframe : window.keyframes()) depths += keyframe.points.count;
  DenseSystem system = zero_system(window.count, depths);
  const int n = system.pose_count;
  int first = n;
  for (int h = 0; h < window.count; ++h) {
    const WindowKeyframe& host = window.keyframes()[h];
    const DepthEquations& of_host = equations.depths[h];
    for (int i = 0; i < host.points.count; ++i) {
      system.g[first + i] = double(of_host.g[i]);
      system.H(first + i, first + i) = 1.0 / double(of_host.H[i]);
      for (int j = h + 1; j < window.count; ++j) {
        Vector6 C;
        for (int k = 0; k < 6; ++k) C[k] = double(of_host.C[j - h - 1][k][i]);
        const Se3 T_host_later = host.T_world_key.inverse() * window.keyframes()[j].T_world_key;
        system.H.block<6, 1>(6 * h, first + i) += C;
        system.H.block<6, 1>(6 * j, first + i) -= T_host_later.adjoint().transpose() * C;
      }
    }
    first += host.points.count;
  }
  system.H.bottomLeftCorner(depths, n) = system.mixed().transpose();
  const Eigen::MatrixXd mixed_depth =
      system.mixed() * system.depths().diagonal().cwiseInverse().asDiagonal();
  for (int i = 0; i < n; ++i) {
    system.g[i] = equations.g[i];
    for (int j = 0; j < n; ++j) system.H(i, j) = equations.H[i * kMaxWindowUnknowns + j];
  }
  const Eigen::MatrixXd eliminated = mixed_depth * system.mixed().transpose();
  system.H.topLeftCorner(n, n) += eliminated;
  system.g.head(n) += mixed_depth * system.g.tail(depths);
  return system;
}

}  // namespace darkling::test
