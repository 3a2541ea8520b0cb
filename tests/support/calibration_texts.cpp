// SPDX-License-Identifier: Apache-2.0
#include "support/calibration_texts.h"

namespace darkling::test {

std::string opencv_intrinsics() {
  return R"(%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 500., 0., 320., 0., 501., 240., 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -2.0000000000000000e-01, 5.0000000000000003e-02, 1e-3, -1e-3, 0. ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 502., 0., 322., 0., 503., 242., 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.21, 0.06, 2e-3, -2e-3, 0. ]
)";
}

std::string opencv_extrinsics() {
  // A turn of a degree about the vertical axis.
  return R"(%YAML:1.0
---
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 0.99984769515639127, 0., 0.017452406437283512, 0., 1., 0.,
       -0.017452406437283512, 0., 0.99984769515639127 ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.12, 0.001, 0.002 ]
)";
}

std::string ros_camera_info(const std::string& name, double P3) {
  return R"(image_width: 640
image_height: 480
camera_name: )" +
         name + R"(
camera_matrix:
  rows: 3
  cols: 3
  data: [500, 0, 320, 0, 501, 240, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.2, 0.05, 0.001, -0.001, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [500, 0, 320, )" +
         std::to_string(P3) + ", 0, 500, 240, 0, 0, 0, 1, 0]\n";
}

std::string euroc_sensor(double y_m) {
  return R"(sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [0, 0, 1, 0.05, -1, 0, 0, )" +
         std::to_string(y_m) + R"(, 0, -1, 0, 0.01, 0, 0, 0, 1]
rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.6, 457.3, 367.2, 248.4] # fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28, 0.07, 0.0002, 1.76e-05]
)";
}

std::string kalibr_camchain() {
  const std::string lens =
      "  camera_model: pinhole\n  intrinsics: [460, 460, 376, 240]\n  resolution: [752, 480]\n"
      "  distortion_model: equidistant\n  distortion_coeffs: [-0.01, 0.02, -0.03, 0.01]\n";
  return "cam0:\n" + lens +
         "  T_cam_imu:\n  - [0, -1, 0, 0]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, 0]\n"
         "  - [0, 0, 0, 1]\n"
         "cam1:\n" +
         lens +
         "  T_cn_cnm1:\n  - [1, 0, 0, -0.1]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n"
         "  - [0, 0, 0, 1]\n";
}

std::string kitti_calib() {
  return "P0: 500 0 320 0 0 500 240 0 0 0 1 0\n"
         "P1: 500 0 320 -60 0 500 240 0 0 0 1 0\n";
}

}  // namespace darkling::test
