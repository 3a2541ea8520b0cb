// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "geometry/camera.h"
#include "geometry/se3.h"

namespace darkling {

// A rectangle on the plane z = 1 of the rectified frames.
struct FieldOfView {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double half_height = 0.0;  // tangent of an angle when centred
  double aspect = 1.0;       // width / height

  [[nodiscard]] double half_width() const { return aspect * half_height; }
};

// One raw camera and how the rectified frame is turned against it.
struct TurnedCamera {
  Camera camera;
  Matrix3 R_raw_rectified = Matrix3::Identity();
};

// The largest rectangle of the given aspect whose every ray is seen by both cameras, at most
// `max_half_width` to each side. Among nearly equal ones the nearest to the optical axis: a
// hundredth of the offset counts against the half height.
// @return nothing when no ray is seen by both cameras.
// Cost: some ten million operations; at start only.
[[nodiscard]] std::optional<FieldOfView> largest_common_field(const TurnedCamera& left,
                                                              const TurnedCamera& right,
                                                              double aspect, double max_half_width);

}  // namespace darkling
