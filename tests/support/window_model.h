// SPDX-License-Identifier: Apache-2.0
// The window's problem as its definition states it (vo/window_equations.h), in double precision and
// without any derivative: what the product's equations and steps are held against.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/window.h"

namespace darkling::test {

// Of all keyframes: poses, and inverse depths in px/m, keyframe by keyframe.
struct WindowState {
  std::vector<Se3> T_world_key;
  std::vector<double> depths;
};
[[nodiscard]] WindowState state_of(const Window& window);

// A point of a host compared with a later keyframe, or with its own stereo disparity (later < 0).
struct Comparison {
  int host = 0;
  int later = -1;  // keyframe, not keyframes later
  int point = 0;   // of the host
  int depth = 0;   // its place in WindowState::depths
};
[[nodiscard]] std::vector<Comparison> comparisons_of(const Window& window);

// Three numbers whose sum of squares is e: of the eight planes' residuals, two along the gradients
// of the patch and one for all that no motion explains.
[[nodiscard]] Vector3 residual(const Window& window, const Comparison& at, const Se3& T_world_host,
                               const Se3& T_world_later, double depth);

// Σ e / (1 + e).
[[nodiscard]] double cost_of(const Window& window, const WindowState& state);

}  // namespace darkling::test
