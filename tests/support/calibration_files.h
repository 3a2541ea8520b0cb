// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geometry/stereo_rig.h"
#include "support/calibration_texts.h"

namespace darkling::test {

// `rig` as OpenCV's own writer puts it: M1, D1, M2, D2, R, T, image_width and image_height.
[[nodiscard]] std::string opencv_calibration(const StereoRig& rig);

// A rig's cameras and the motion between them are equal to within `tolerance`; Body does not count.
void expect_same_pair(const StereoRig& a, const StereoRig& b, double tolerance);

}  // namespace darkling::test
