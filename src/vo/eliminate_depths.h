// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "vo/window_equations.h"

namespace darkling {

// The motion η of a host's points against each later keyframe: normal equations of these, from
// which the depths are then eliminated.
struct RelativeEquations {
  int count = 0;                                   // later keyframes
  std::array<Matrix6, kMaxWindowKeyframes - 1> H;  // of one η and itself, depths not yet eliminated
  std::array<Vector6, kMaxWindowKeyframes - 1> g;
  std::array<Matrix6, kMaxWindowKeyframes - 1> Ad_host_later;
};

// Takes the depths out of a host's equations, and adds what is left to those of the keyframes.
// @param depths  with the inverse of H.
// @param point_count  of the host.
void eliminate_depths(const RelativeEquations& relative, const DepthEquations& depths,
                      int point_count, int host, WindowEquations& equations);

}  // namespace darkling
