// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geometry/stereo_rig.h"

namespace darkling::test {

// `rig` as OpenCV's own writer puts it: M1, D1, M2, D2, R, T, image_width and image_height.
[[nodiscard]] std::string opencv_calibration(const StereoRig& rig);

// Two pinholes of 640x480 px, 0.12 m apart, the right one turned by a degree; each number chosen by
// hand. The intrinsics of both, then R and T, without a size.
[[nodiscard]] std::string opencv_intrinsics();
[[nodiscard]] std::string opencv_extrinsics();

// camera_info of one camera of a rectified pair of 640x480 px and 0.12 m.
// @param P3  of the projection: -fx * baseline, with fx = 500.
[[nodiscard]] std::string ros_camera_info(const std::string& name, double P3);

// A rig's cameras and the motion between them are equal to within `tolerance`; Body does not count.
void expect_same_pair(const StereoRig& a, const StereoRig& b, double tolerance);

}  // namespace darkling::test
