// SPDX-License-Identifier: Apache-2.0
// Small sound calibrations as each project writes them.
#pragma once

#include <string>

namespace darkling::test {

// Two pinholes of 640x480 px, 0.12 m apart, the right one turned by a degree; each number chosen by
// hand. The intrinsics of both, then R and T, without a size.
[[nodiscard]] std::string opencv_intrinsics();
[[nodiscard]] std::string opencv_extrinsics();

// camera_info of one camera of a rectified pair of 640x480 px and 0.12 m.
// @param P3  of the projection: -fx * baseline, with fx = 500.
[[nodiscard]] std::string ros_camera_info(const std::string& name, double P3);

// One sensor.yaml of EuRoC. @param y_m  of the camera on the body.
[[nodiscard]] std::string euroc_sensor(double y_m);

// A camchain with both ways of placing the right camera, 0.1 m beside the left.
[[nodiscard]] std::string kalibr_camchain();

// P0 and P1, 0.12 m apart.
[[nodiscard]] std::string kitti_calib();

}  // namespace darkling::test
