// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/frames.h"
#include "io/calibration.h"
#include "support/calibration_files.h"
#include "support/temporary_folder.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

class RosCalibration : public ::testing::Test {
 protected:
  RosCalibration() {
    write_text(left_, ros_camera_info("left", 0.0));
    write_text(right_, ros_camera_info("right", -60.0));
  }

  Result<StereoRig> load() { return load_ros_calibration(left_, right_); }

  void expect_refused(const std::string& path, const char* from, const char* to,
                      std::initializer_list<const char*> words) {
    const std::string before = read_text(path);
    replace_in_file(path, from, to);
    const auto rig = load();
    write_text(path, before);
    ASSERT_FALSE(rig.has_value()) << from << " -> " << to;
    EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
    EXPECT_THAT(rig.error().message, HasSubstr(path));
    for (const char* word : words) EXPECT_THAT(rig.error().message, HasSubstr(word));
  }

  TemporaryFolder folder_;
  std::string left_ = folder_ / "left.yaml";
  std::string right_ = folder_ / "right.yaml";
};

TEST_F(RosCalibration, ReadsEveryNumber) {
  const auto rig = load();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->left.width, 640);
  EXPECT_EQ(rig->right.height, 480);
  EXPECT_EQ(rig->left.fx, 500.0);
  EXPECT_EQ(rig->right.fy, 501.0);
  EXPECT_EQ(rig->right.cx, 320.0);
  EXPECT_EQ(rig->left.distortion, Distortion::kRadTan);
  EXPECT_THAT(rig->left.coefficients, ::testing::ElementsAre(-0.2, 0.05, 1e-3, -1e-3));
  const Se3 T_left_right = rig->T_body_rawleft.inverse() * rig->T_body_rawright;
  EXPECT_LT((T_left_right.translation() - Vector3(0.12, 0, 0)).norm(), 1e-12);
  EXPECT_LT(minus(rig->T_body_rawleft, Se3(R_vehicle_optical(), Vector3::Zero())).norm(), 1e-12);
}

// The raw left camera looks 0.1 rad to the right of the rectified one: a ray straight ahead of it
// lies at (sin, 0, cos) when rectified, and the right camera, which is not turned, looks 0.1 rad to
// the left of it.
TEST_F(RosCalibration, TakesRFromRawToRectified) {
  replace_in_file(left_, "[1, 0, 0, 0, 1, 0, 0, 0, 1]",
                  "[0.995004165, 0, 0.099833417, 0, 1, 0, -0.099833417, 0, 0.995004165]");
  const auto rig = load();
  ASSERT_TRUE(rig) << rig.error().message;
  const Se3 T_left_right = rig->T_body_rawleft.inverse() * rig->T_body_rawright;
  const Vector3 right_axis = T_left_right.R() * Vector3(0, 0, 1);
  EXPECT_LT((right_axis - Vector3(-0.099833417, 0, 0.995004165)).norm(), 1e-8);
  EXPECT_NEAR(T_left_right.translation().norm(), 0.12, 1e-9);
  EXPECT_NEAR(T_left_right.translation().z(), 0.12 * 0.099833417, 1e-9);
}

TEST_F(RosCalibration, TakesFisheyeLenses) {
  for (const char* name : {"equidistant", "fisheye"}) {
    for (const std::string& path : {left_, right_}) {
      write_text(path, ros_camera_info("eye", path == left_ ? 0.0 : -60.0));
      replace_in_file(path, "plumb_bob", name);
      replace_in_file(path, "cols: 5", "cols: 4");
      replace_in_file(path, "-0.001, 0]", "-0.001]");
    }
    const auto rig = load();
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->right.distortion, Distortion::kEquidistant);
  }
}

TEST_F(RosCalibration, RefusesTheRationalModelWithAWayOut) {
  expect_refused(right_, "plumb_bob", "rational_polynomial",
                 {"'distortion_model'", "'rational_polynomial'", "calibrate again with plumb_bob"});
  expect_refused(right_, "plumb_bob", "plump_bob", {":8:", "'plump_bob'", "allowed is plumb_bob"});
}

TEST_F(RosCalibration, RefusesAThirdRadialCoefficient) {
  expect_refused(left_, "-0.001, 0]", "-0.001, 0.02]", {"'distortion_coefficients'", "k3 = 0.02"});
}

TEST_F(RosCalibration, NamesSwappedEyes) {
  std::swap(left_, right_);
  const auto rig = load();
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message, HasSubstr("swapped"));
}

TEST_F(RosCalibration, SaysThatCamerasCalibratedOneByOneAreNoPair) {
  expect_refused(right_, "-60.000000", "0", {"'projection_matrix'", "no baseline", "stereo pair"});
}

TEST_F(RosCalibration, SuspectsMillimetres) {
  expect_refused(right_, "-60.000000", "-60000", {"baseline of 120 m", "in mm"});
}

TEST_F(RosCalibration, RefusesPairsMountedOneAboveTheOther) {
  expect_refused(right_, "-60.000000, 0, 500, 240, 0,", "0, 0, 500, 240, -60,",
                 {"one above the other"});
}

TEST_F(RosCalibration, RefusesAProjectionThatIsNotRectified) {
  expect_refused(right_, "[500, 0, 320, -60", "[500, 2, 320, -60", {"no rectified camera has"});
  expect_refused(right_, "[500, 0, 320, -60", "[0, 0, 320, -60", {"no rectified camera has"});
  expect_refused(right_, "cols: 4", "cols: 3", {"'projection_matrix'", "12 numbers", "3x3"});
}

TEST_F(RosCalibration, NamesEveryMissingKey) {
  for (const char* key : {"image_width", "image_height", "camera_matrix", "distortion_model",
                          "distortion_coefficients", "rectification_matrix", "projection_matrix"}) {
    expect_refused(left_, (std::string(key) + ":").c_str(), "other:", {key, "found nothing"});
  }
}

TEST_F(RosCalibration, RefusesImagesOfDifferentSizes) {
  expect_refused(right_, "image_width: 640", "image_width: 800", {"800x480"});
  expect_refused(right_, "image_width: 640", "image_width: 640.5", {"'640.5'", "whole px"});
}

TEST_F(RosCalibration, RefusesACameraThatIsNotCalibrated) {
  expect_refused(left_, "[500, 0, 320, 0, 501, 240, 0, 0, 1]", "[0, 0, 0, 0, 0, 0, 0, 0, 0]",
                 {"'camera_matrix'", "focal lengths 0 and 0"});
}

}  // namespace
}  // namespace darkling::test
