// SPDX-License-Identifier: Apache-2.0
#include "geometry/frames.h"
#include "io/calibration.h"
#include "io/calibration_yaml.h"

namespace darkling {

namespace {

// Where the cameras sit on the body. Kalibr writes T_cam_imu = T_camera_body and
// T_cn_cnm1 = T_right_left.
Result<void> place_cameras(const YamlSection& cam0, const YamlSection& cam1, StereoRig& rig) {
  rig.T_body_rawleft = Se3(R_vehicle_optical(), Vector3::Zero());
  if (has_key(cam0, "T_cam_imu")) {
    const auto T_left_body = yaml_motion(cam0, "T_cam_imu");
    if (!T_left_body) return tl::unexpected(T_left_body.error());
    rig.T_body_rawleft = T_left_body->inverse();
  }
  if (has_key(cam1, "T_cn_cnm1")) {
    const auto T_right_left = yaml_motion(cam1, "T_cn_cnm1");
    if (!T_right_left) return tl::unexpected(T_right_left.error());
    rig.T_body_rawright = rig.T_body_rawleft * T_right_left->inverse();
    return {};
  }
  if (has_key(cam0, "T_cam_imu") && has_key(cam1, "T_cam_imu")) {
    const auto T_right_body = yaml_motion(cam1, "T_cam_imu");
    if (!T_right_body) return tl::unexpected(T_right_body.error());
    rig.T_body_rawright = T_right_body->inverse();
    return {};
  }
  return wrong_value(cam1, "T_cn_cnm1", "nothing",
                     "16 numbers: the motion from cam0 to cam1 (or T_cam_imu for both)");
}

}  // namespace

Result<StereoRig> load_kalibr_calibration(const std::string& path) {
  const auto chain = read_yaml_file(path);
  if (!chain) return tl::unexpected(chain.error());
  const auto cam0 = yaml_section(*chain, "cam0");
  if (!cam0) return tl::unexpected(cam0.error());
  const auto cam1 = yaml_section(*chain, "cam1");
  if (!cam1) return tl::unexpected(cam1.error());
  const auto left = yaml_camera(*cam0, "distortion_coeffs");
  if (!left) return tl::unexpected(left.error());
  const auto right = yaml_camera(*cam1, "distortion_coeffs");
  if (!right) return tl::unexpected(right.error());
  StereoRig rig;
  rig.left = *left;
  rig.right = *right;
  if (auto placed = place_cameras(*cam0, *cam1, rig); !placed) {
    return tl::unexpected(placed.error());
  }
  if (auto checked = check_rig(rig); !checked) {
    return failure(checked.error().code, path + ": " + checked.error().message);
  }
  return rig;
}

}  // namespace darkling
