// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "geometry/se3.h"

namespace darkling {

enum class Distortion {
  kNone,         // pinhole
  kRadTan,       // k1, k2, p1, p2: Brown's model as OpenCV, EuRoC and Kalibr ("radtan") write it
  kEquidistant,  // k1..k4: Kannala-Brandt as OpenCV's fisheye and Kalibr ("equi") write it
};

// A camera's intrinsics: pinhole with one of three distortions. Units px unless said.
struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;  // the centre of the top-left pixel is 0
  double cy = 0.0;
  Distortion distortion = Distortion::kNone;
  std::array<double, 4> coefficients = {};  // dimensionless, order as in Distortion
};

// Where the point `p` in the camera's optical frame (m, any scale) appears, in px; also outside the
// image. @pre p.z() > 0 for kNone and kRadTan; for kEquidistant p is not on the axis behind the
// camera. Radial-tangential distortion folds back on itself far from the axis; use unproject() to
// ask whether a pixel comes from inside the domain.
[[nodiscard]] Eigen::Vector2d project(const Camera& camera, const Vector3& p);

// As project(), with the 2×3 derivative by `p` in `J`.
[[nodiscard]] Eigen::Vector2d project(const Camera& camera, const Vector3& p,
                                      Eigen::Matrix<double, 2, 3>& J);

// The unit viewing ray of a pixel in the optical frame, or nothing where the model has no such ray
// (outside the domain in which the distortion is one-to-one).
[[nodiscard]] std::optional<Vector3> unproject(const Camera& camera, const Eigen::Vector2d& pixel);

}  // namespace darkling
