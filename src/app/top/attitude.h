// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/se3.h"

namespace darkling {

// A rotation for people: R = Rz(yaw) Ry(pitch) Rx(roll), deg. With x forward, y left and z up, a
// positive yaw is a turn to the left, a positive pitch nose down, a positive roll right side down.
struct Attitude {
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};

// @param q  of T_world_body, unit.
[[nodiscard]] inline Attitude attitude_of(const Eigen::Quaterniond& q) {
  const Matrix3 R = q.toRotationMatrix();
  constexpr double kDegPerRad = 57.29577951308232;
  return {.yaw_deg = std::atan2(R(1, 0), R(0, 0)) * kDegPerRad,
          .pitch_deg = std::asin(std::clamp(-R(2, 0), -1.0, 1.0)) * kDegPerRad,
          .roll_deg = std::atan2(R(2, 1), R(2, 2)) * kDegPerRad};
}

}  // namespace darkling
