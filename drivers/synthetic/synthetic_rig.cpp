// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/synthetic_rig.h"

#include <cmath>
#include <numbers>

#include "geometry/frames.h"

namespace darkling {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFieldOfView_deg = 85.0;  // across, without distortion
constexpr double kBaseline_m = 0.12;
constexpr double kPitchDown_deg = 8.0;

}  // namespace

StereoRig make_synthetic_rig(const SyntheticSpec& spec) {
  Camera camera;
  camera.width = spec.width;
  camera.height = spec.height;
  camera.fx = camera.fy = 0.5 * spec.width / std::tan(0.5 * kFieldOfView_deg * kDegree);
  camera.cx = 0.5 * (spec.width - 1);
  camera.cy = 0.5 * (spec.height - 1);
  if (spec.distortion > 0.0) {
    camera.distortion = Distortion::kRadTan;
    camera.coefficients = {-0.28 * spec.distortion, 0.074 * spec.distortion,
                           0.0004 * spec.distortion, -0.0003 * spec.distortion};
  }
  StereoRig rig;
  rig.left = rig.right = camera;
  const Matrix3 R =
      so3_exp({0, kPitchDown_deg * kDegree, 0}).toRotationMatrix() * R_vehicle_optical();
  const Matrix3 R_roll = so3_exp({0, 0, spec.roll_right_deg * kDegree}).toRotationMatrix();
  rig.T_body_rawleft = Se3(R, {0.15, 0.5 * kBaseline_m, 0.42});
  rig.T_body_rawright = Se3(Matrix3(R * R_roll), {0.15, -0.5 * kBaseline_m, 0.42});
  return rig;
}

}  // namespace darkling
