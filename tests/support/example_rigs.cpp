// SPDX-License-Identifier: Apache-2.0
#include "support/example_rigs.h"

#include <numbers>

#include "geometry/frames.h"

namespace darkling::test {

namespace {

Se3 euroc_left_pose() {
  Matrix3 R;
  R << 0.0148655429818, -0.999880929698, 0.00414029679422,  //
      0.999557249008, 0.0149672133247, 0.025715529948,      //
      -0.0257744366974, 0.00375618835797, 0.999660727178;
  return {R, Vector3(-0.0216401454975, -0.064676986768, 0.00981073058949)};
}

Se3 euroc_right_pose() {
  Matrix3 R;
  R << 0.0125552670891, -0.999755099723, 0.0182237714554,  //
      0.999598781151, 0.0130119051815, 0.0251588363115,    //
      -0.0253898008918, 0.0179005838253, 0.999517347078;
  return {R, Vector3(-0.0198435579556, 0.0453689425024, 0.00786212447038)};
}

}  // namespace

StereoRig euroc_rig() {
  StereoRig rig;
  rig.left = {.width = 752,
              .height = 480,
              .fx = 458.654,
              .fy = 457.296,
              .cx = 367.215,
              .cy = 248.375,
              .distortion = Distortion::kRadTan,
              .coefficients = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}};
  rig.right = {.width = 752,
               .height = 480,
               .fx = 457.587,
               .fy = 456.134,
               .cx = 379.999,
               .cy = 255.238,
               .distortion = Distortion::kRadTan,
               .coefficients = {-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05}};
  rig.T_body_rawleft = euroc_left_pose();
  rig.T_body_rawright = euroc_right_pose();
  return rig;
}

StereoRig fisheye_rig() {
  StereoRig rig;
  rig.left = {.width = 512,
              .height = 512,
              .fx = 190.98,
              .fy = 190.97,
              .cx = 254.93,
              .cy = 256.90,
              .distortion = Distortion::kEquidistant,
              .coefficients = {0.0034, 0.0007, -0.0020, 0.0002}};
  rig.right = {.width = 512,
               .height = 512,
               .fx = 190.44,
               .fy = 190.43,
               .cx = 252.60,
               .cy = 254.92,
               .distortion = Distortion::kEquidistant,
               .coefficients = {0.0034, 0.0018, -0.0027, 0.0003}};
  rig.T_body_rawleft = Se3(R_vehicle_optical(), Vector3(0.05, 0.04, 0.02));
  const Se3 T_rawleft_rawright(so3_exp(Vector3(0.017, -0.004, 0.002)),
                               Vector3(0.1009, 0.0019, 0.0012));
  rig.T_body_rawright = rig.T_body_rawleft * T_rawleft_rawright;
  return rig;
}

StereoRig kitti_rig() {
  StereoRig rig;
  rig.left = {.width = 1226,
              .height = 370,
              .fx = 707.0912,
              .fy = 707.0912,
              .cx = 601.8873,
              .cy = 183.1104,
              .distortion = Distortion::kNone,
              .coefficients = {}};
  rig.right = rig.left;
  rig.T_body_rawleft = Se3(R_vehicle_optical(), Vector3::Zero());
  rig.T_body_rawright =
      rig.T_body_rawleft * Se3(Matrix3(Matrix3::Identity()), Vector3(0.537150, 0.0, 0.0));
  return rig;
}

StereoRig upside_down_rig() {
  StereoRig rig = euroc_rig();
  // Turned about the body's z axis, which EuRoC's cameras look along.
  const Se3 T_turned_body(so3_exp(Vector3(0.0, 0.0, std::numbers::pi)), Vector3(0.1, 0.2, 0.3));
  rig.T_body_rawleft = T_turned_body * rig.T_body_rawleft;
  rig.T_body_rawright = T_turned_body * rig.T_body_rawright;
  return rig;
}

StereoRig toed_in_rig() {
  StereoRig rig;
  rig.left = {.width = 640,
              .height = 480,
              .fx = 500.0,
              .fy = 500.0,
              .cx = 319.5,
              .cy = 239.5,
              .distortion = Distortion::kNone,
              .coefficients = {}};
  rig.right = rig.left;
  const double half_rad = 2.0 * std::numbers::pi / 180.0;
  const Se3 T_body_midway(R_vehicle_optical(), Vector3::Zero());
  rig.T_body_rawleft =
      T_body_midway * Se3(so3_exp(Vector3(0.0, half_rad, 0.0)), Vector3(-0.1, 0.0, 0.0));
  rig.T_body_rawright =
      T_body_midway * Se3(so3_exp(Vector3(0.0, -half_rad, 0.0)), Vector3(0.1, 0.0, 0.0));
  return rig;
}

StereoRig folding_radtan_rig() {
  StereoRig rig = toed_in_rig();
  for (Camera* camera : {&rig.left, &rig.right}) {
    camera->fx = camera->fy = 300.0;
    camera->distortion = Distortion::kRadTan;
    camera->coefficients = {-0.4, 0.0, 0.0, 0.0};  // folds 183 px from the principal point
  }
  return rig;
}

StereoRig folding_fisheye_rig() {
  StereoRig rig = toed_in_rig();
  for (Camera* camera : {&rig.left, &rig.right}) {
    camera->fx = camera->fy = 300.0;
    camera->distortion = Distortion::kEquidistant;
    camera->coefficients = {-0.5, 0.0, 0.0, 0.0};  // folds 163 px from it, 47° off the axis
  }
  return rig;
}

Vector3 rectified_ray(const RectifiedRig& rig, double u, double v) {
  return {(u - rig.cx) / rig.focal_px, (v - rig.cy) / rig.focal_px, 1.0};
}

}  // namespace darkling::test
