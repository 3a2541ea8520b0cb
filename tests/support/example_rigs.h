// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/stereo_rig.h"

namespace darkling::test {

// The rig of the EuRoC recordings: 752x480, radial-tangential, about 1.4° between the cameras, its
// body the IMU. Numbers as published in the recordings' sensor.yaml.
[[nodiscard]] StereoRig euroc_rig();

// Like the cameras of the TUM-VI recordings: 512x512 fisheyes of 190 px focal length, equidistant,
// seeing past 90° from the axis in the corners, about a degree between them, 0.101 m apart.
[[nodiscard]] StereoRig fisheye_rig();

// Like KITTI's rectified grey cameras: 1226x370, f 707.0912 px, baseline 0.537 m, no distortion.
[[nodiscard]] StereoRig kitti_rig();

// The EuRoC cameras, the pair mounted upside down: still left of right in the images.
[[nodiscard]] StereoRig upside_down_rig();

// Two pinholes of 640x480 that look 4° towards each other, 0.2 m apart.
[[nodiscard]] StereoRig toed_in_rig();

// The same pair with lenses whose model folds back on itself inside the image.
[[nodiscard]] StereoRig folding_radtan_rig();
[[nodiscard]] StereoRig folding_fisheye_rig();

// A pixel's ray in the rectified left (or right) frame, z = 1.
[[nodiscard]] Vector3 rectified_ray(const RectifiedRig& rig, double u, double v);

}  // namespace darkling::test
