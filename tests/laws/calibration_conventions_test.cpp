// SPDX-License-Identifier: Apache-2.0
// The directions of the imported motions, held against OpenCV's own use of the same numbers.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "io/calibration.h"
#include "support/calibration_files.h"
#include "support/example_rigs.h"
#include "support/temporary_folder.h"

namespace darkling::test {
namespace {

// What the file that OpenCV wrote says of itself.
struct Written {
  cv::Mat M1, D1, M2, D2, R, T;
  cv::Size size;
};

Written read_with_opencv(const std::string& text) {
  const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  Written written;
  file["M1"] >> written.M1;
  file["D1"] >> written.D1;
  file["M2"] >> written.M2;
  file["D2"] >> written.D2;
  file["R"] >> written.R;
  file["T"] >> written.T;
  written.size =
      cv::Size(static_cast<int>(file["image_width"]), static_cast<int>(file["image_height"]));
  return written;
}

std::string to_yaml(const char* key, const cv::Mat& M) {
  std::ostringstream text;
  text.precision(17);
  text << key << ":\n  rows: " << M.rows << "\n  cols: " << M.cols << "\n  data: [";
  const char* separator = "";
  for (int row = 0; row < M.rows; ++row) {
    for (int col = 0; col < M.cols; ++col) {
      text << separator << M.at<double>(row, col);
      separator = ", ";
    }
  }
  text << "]\n";
  return text.str();
}

std::string ros_text(const Written& written, const cv::Mat& M, const cv::Mat& D, const cv::Mat& R,
                     const cv::Mat& P) {
  return "image_width: " + std::to_string(written.size.width) +
         "\nimage_height: " + std::to_string(written.size.height) +
         "\ndistortion_model: plumb_bob\n" + to_yaml("camera_matrix", M) +
         to_yaml("distortion_coefficients", D) + to_yaml("rectification_matrix", R) +
         to_yaml("projection_matrix", P);
}

class CalibrationConventions : public ::testing::TestWithParam<StereoRig> {};

// A point of the left camera's frame appears in the right image where cv::projectPoints() puts it
// with the file's R, T, M2, D2.
TEST_P(CalibrationConventions, OfOpencvAreThoseOfItsProjection) {
  const TemporaryFolder folder;
  const std::string text = opencv_calibration(GetParam());
  write_text(folder / "stereo.yml", text);
  const auto rig = load_calibration(folder / "stereo.yml");
  ASSERT_TRUE(rig) << rig.error().message;
  const Written written = read_with_opencv(text);
  cv::Mat rotation_vector;
  cv::Rodrigues(written.R, rotation_vector);
  for (const Vector3& p_left : {Vector3(0.1, -0.2, 2.0), Vector3(-0.7, 0.3, 1.5)}) {
    const std::vector<cv::Point3d> points = {{p_left.x(), p_left.y(), p_left.z()}};
    std::vector<cv::Point2d> pixels;
    cv::projectPoints(points, rotation_vector, written.T, written.M2, written.D2, pixels);
    const Vector3 p_right = rig->T_body_rawright.inverse() * (rig->T_body_rawleft * p_left);
    const Eigen::Vector2d pixel = project(rig->right, p_right);
    EXPECT_NEAR(pixel.x(), pixels.front().x, 1e-9);
    EXPECT_NEAR(pixel.y(), pixels.front().y, 1e-9);
  }
}

// What cv::stereoRectify() makes of R and T is what ROS's camera_info holds: both say the same rig.
TEST_P(CalibrationConventions, OfRosAreThoseOfOpencvsRectification) {
  const TemporaryFolder folder;
  const Written w = read_with_opencv(opencv_calibration(GetParam()));
  cv::Mat R1, R2, P1, P2, Q;
  cv::stereoRectify(w.M1, w.D1, w.M2, w.D2, w.size, w.R, w.T, R1, R2, P1, P2, Q);
  write_text(folder / "left.yaml", ros_text(w, w.M1, w.D1, R1, P1));
  write_text(folder / "right.yaml", ros_text(w, w.M2, w.D2, R2, P2));
  write_text(folder / "stereo.yml", opencv_calibration(GetParam()));
  const auto ros = load_calibration(folder.path());
  const auto opencv = load_calibration(folder / "stereo.yml");
  ASSERT_TRUE(ros) << ros.error().message;
  ASSERT_TRUE(opencv) << opencv.error().message;
  expect_same_pair(*ros, *opencv, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Rigs, CalibrationConventions,
                         ::testing::Values(euroc_rig(), toed_in_rig(), kitti_rig()));

}  // namespace
}  // namespace darkling::test
