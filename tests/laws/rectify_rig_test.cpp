// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "geometry/stereo_rig.h"
#include "support/example_rigs.h"

namespace darkling::test {
namespace {

cv::Matx33d to_cv(const Matrix3& R) {
  cv::Matx33d out;
  for (int i = 0; i < 9; ++i) out.val[i] = R(i / 3, i % 3);
  return out;
}

double distance(const cv::Matx33d& a, const Matrix3& b) {
  return cv::norm(a - to_cv(b));
}

cv::Matx33d camera_matrix(const Camera& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

// cv::stereoRectify chooses the turn by the same rule; its rotations do not depend on the lenses.
TEST(RectifyRig, TurnsTheCamerasAsOpenCvDoes) {
  for (const StereoRig& rig : {euroc_rig(), fisheye_rig(), toed_in_rig(), upside_down_rig()}) {
    const Se3 T_rawright_rawleft = rig.T_body_rawright.inverse() * rig.T_body_rawleft;
    const Vector3 t = T_rawright_rawleft.translation();
    cv::Matx33d R_left_rawleft;
    cv::Matx33d R_right_rawright;
    cv::Matx34d P_left;
    cv::Matx34d P_right;
    cv::Matx44d Q;
    cv::stereoRectify(camera_matrix(rig.left), cv::noArray(), camera_matrix(rig.right),
                      cv::noArray(), cv::Size(rig.left.width, rig.left.height),
                      to_cv(T_rawright_rawleft.R()), cv::Vec3d(t.x(), t.y(), t.z()), R_left_rawleft,
                      R_right_rawright, P_left, P_right, Q);
    const auto rectified = rectify_rig(rig, 0);
    ASSERT_TRUE(rectified.has_value()) << rectified.error().message;
    EXPECT_LT(distance(R_left_rawleft.t(), rectified->R_rawleft_left), 1e-9);
    EXPECT_LT(distance(R_right_rawright.t(), rectified->R_rawright_right), 1e-9);
    EXPECT_NEAR(-P_right(0, 3) / P_right(0, 0), rectified->baseline_m, 1e-9);
  }
}

}  // namespace
}  // namespace darkling::test
