// SPDX-License-Identifier: Apache-2.0
// Calibrations as other projects write them, read into a StereoRig. Every one is checked as a whole
// by check_rig(); every error is kConfiguration and says file, line, key, what was found and what
// is allowed.
#pragma once

#include <optional>
#include <string>

#include "base/image_size.h"
#include "base/result.h"
#include "geometry/stereo_rig.h"

namespace darkling {

// Recognises by content what `path` is, and loads it:
//   Kalibr camchain, or the folder of the only one;
//   EuRoC folder `mav0`, one that holds it, or `sensor.yaml` of either camera;
//   KITTI calib.txt, or its folder;
//   OpenCV stereo YAML, or intrinsics.yml and extrinsics.yml side by side, or their folder;
//   ROS camera_info: a folder of left.yaml and right.yaml, either of them, or "LEFT,RIGHT".
// @param size  of the images, where that is known: KITTI's and many of OpenCV's do not say.
// @return kConfiguration whatever is wrong; never throws.
[[nodiscard]] Result<StereoRig> load_calibration(const std::string& path,
                                                 std::optional<ImageSize> size = std::nullopt);

// OpenCV's stereo calibration: M1, D1, M2, D2 (or K1…, cameraMatrix1, distCoeffs1…), R, T (m) and
// image_width and image_height, or imageSize. Distortion is radial-tangential unless
// `fisheye_model: 1` or `distortion_model: fisheye` says otherwise. Body is vehicle axes at the
// left camera.
// @param intrinsics_path, extrinsics_path  may be the same.
// @param size  counts where neither file says.
[[nodiscard]] Result<StereoRig> load_opencv_calibration(const std::string& intrinsics_path,
                                                        const std::string& extrinsics_path,
                                                        std::optional<ImageSize> size);

// ROS camera_info of a pair that was calibrated together. Body is vehicle axes at the left camera.
[[nodiscard]] Result<StereoRig> load_ros_calibration(const std::string& left_path,
                                                     const std::string& right_path);

// KITTI odometry `calib.txt`: the projections P0 and P1 (12 numbers, row-major 3×4) of the
// rectified grey cameras. KITTI names no body: vehicle axes at the left camera stand in.
// @param width, height  px, of the images; the file does not say.
[[nodiscard]] Result<StereoRig> load_kitti_calibration(const std::string& path, int width,
                                                       int height);

// EuRoC `cam0/sensor.yaml` and `cam1/sensor.yaml` in the folder `mav0`: `T_BS` is T_body_camera.
[[nodiscard]] Result<StereoRig> load_euroc_calibration(const std::string& mav0_folder);

// Kalibr `camchain.yaml`: `T_cn_cnm1` of cam1 is T_right_left, `T_cam_imu` is T_camera_body. Where
// both place the right camera, `T_cn_cnm1` does. Without `T_cam_imu`, Body is vehicle axes at the
// left camera.
[[nodiscard]] Result<StereoRig> load_kalibr_calibration(const std::string& path);

// Which file calibrates a folder in EuRoC's layout.
struct EurocCalibrationChoice {
  std::string path;  // a camchain file, or the folder `mav0` whose sensor.yaml files count
  bool is_kalibr = false;
};

// The sensor.yaml files count when both hold intrinsics, else the one `camchain*.yaml` in `folder`,
// in `folder/dso` or in `folder/mav0`.
// @param folder  the one that holds `mav0`.
// @return kConfiguration when there is neither, or more than one camchain.
[[nodiscard]] Result<EurocCalibrationChoice> choose_euroc_calibration(const std::string& folder);

// Whether there is such a camchain.
[[nodiscard]] bool has_camchain(const std::string& folder);

}  // namespace darkling
