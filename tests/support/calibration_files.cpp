// SPDX-License-Identifier: Apache-2.0
#include "support/calibration_files.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace darkling::test {

namespace {

cv::Mat to_mat(const Matrix3& M) {
  cv::Mat mat(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) mat.at<double>(row, col) = M(row, col);
  }
  return mat;
}

void write_camera(cv::FileStorage& file, const std::string& number, const Camera& camera) {
  Matrix3 K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  file << "M" + number << to_mat(K);
  cv::Mat D = cv::Mat::zeros(1, camera.distortion == Distortion::kEquidistant ? 4 : 5, CV_64F);
  std::copy(camera.coefficients.begin(), camera.coefficients.end(), D.begin<double>());
  file << "D" + number << D;
}

void expect_same_camera(const Camera& a, const Camera& b, double tolerance) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_NEAR(a.fx, b.fx, tolerance);
  EXPECT_NEAR(a.fy, b.fy, tolerance);
  EXPECT_NEAR(a.cx, b.cx, tolerance);
  EXPECT_NEAR(a.cy, b.cy, tolerance);
  EXPECT_EQ(a.distortion, b.distortion);
  for (std::size_t i = 0; i < a.coefficients.size(); ++i) {
    EXPECT_NEAR(a.coefficients.at(i), b.coefficients.at(i), tolerance);
  }
}

}  // namespace

std::string opencv_calibration(const StereoRig& rig) {
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "image_width" << rig.left.width << "image_height" << rig.left.height;
  if (rig.left.distortion == Distortion::kEquidistant) file << "fisheye_model" << 1;
  write_camera(file, "1", rig.left);
  write_camera(file, "2", rig.right);
  const Se3 T_right_left = rig.T_body_rawright.inverse() * rig.T_body_rawleft;
  const Vector3& t = T_right_left.translation();
  file << "R" << to_mat(T_right_left.R());
  file << "T" << (cv::Mat_<double>(3, 1) << t.x(), t.y(), t.z());
  return file.releaseAndGetString();
}

void expect_same_pair(const StereoRig& a, const StereoRig& b, double tolerance) {
  expect_same_camera(a.left, b.left, tolerance);
  expect_same_camera(a.right, b.right, tolerance);
  const Se3 T_a = a.T_body_rawleft.inverse() * a.T_body_rawright;
  const Se3 T_b = b.T_body_rawleft.inverse() * b.T_body_rawright;
  EXPECT_LT(minus(T_a, T_b).norm(), tolerance);
}

}  // namespace darkling::test
