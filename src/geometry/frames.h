// SPDX-License-Identifier: Apache-2.0
// Frames, axes and signs: stated here once, relied on everywhere.
//
//   Left, Right  rectified optical frames: x right, y down, z forward; metres.
//   RawLeft, RawRight  optical frames of the cameras as mounted, before rectification.
//   Body         the rig's own: x forward, y left, z up, unless the calibration says otherwise.
//   World        the Body frame of the first pose.
//
// T_a_b maps coordinates of b to coordinates of a: p_a = T_a_b * p_b, and inner names cancel:
// T_world_left = T_world_key * T_key_left. Tangent vectors are (translation, rotation); increments
// are applied on the right: T ⊞ ξ = T · exp(ξ).
//
// Pixels: the centre of the top-left pixel is (0, 0), so an image covers [-0.5, width - 0.5).
// Reducing k×k boxes to one pixel maps a coordinate c to (c + 0.5) / k - 0.5.
//
// Disparity d = u_left - u_right >= 0 px; depth z = f · b / d with focal length f in px and
// baseline b > 0 in m.
#pragma once

#include <Eigen/Core>

namespace darkling {

// Rotation from the optical axes (x right, y down, z forward) to vehicle axes (x forward, y left,
// z up): the Body of a rig whose calibration names none.
[[nodiscard]] inline Eigen::Matrix3d R_vehicle_optical() {
  Eigen::Matrix3d R;
  R << 0, 0, 1,  //
      -1, 0, 0,  //
      0, -1, 0;
  return R;
}

// Where the coordinate `c` of a full-size pixel lies after every k×k box became one pixel.
[[nodiscard]] constexpr double reduce_pixel(double c, double k) {
  return (c + 0.5) / k - 0.5;
}

}  // namespace darkling
