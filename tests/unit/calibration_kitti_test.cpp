// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/frames.h"
#include "io/calibration.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kP0 = "P0: 700 0 600 0 0 700 180 0 0 0 1 0\n";
constexpr const char* kP1 = "P1: 700 0 600 -378 0 700 180 0 0 0 1 0\n";

class KittiCalibration : public ::testing::Test {
 protected:
  Result<StereoRig> load(const std::string& content) {
    write_text(path_, content);
    return load_kitti_calibration(path_, 1226, 370);
  }

  // Expects a refusal that names the file and holds `words`.
  void expect_refused(const std::string& content, std::initializer_list<const char*> words) {
    const auto rig = load(content);
    ASSERT_FALSE(rig.has_value());
    EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
    EXPECT_THAT(rig.error().message, HasSubstr(path_));
    for (const char* word : words) EXPECT_THAT(rig.error().message, HasSubstr(word));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "calib.txt";
};

TEST_F(KittiCalibration, ReadsIntrinsicsAndBaseline) {
  const auto rig = load(std::string(kP0) + kP1);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->left.width, 1226);
  EXPECT_EQ(rig->right.height, 370);
  EXPECT_EQ(rig->left.fx, 700.0);
  EXPECT_EQ(rig->left.cx, 600.0);
  EXPECT_EQ(rig->right.cy, 180.0);
  EXPECT_EQ(rig->left.distortion, Distortion::kNone);
  const Se3 T_left_right = rig->T_body_rawleft.inverse() * rig->T_body_rawright;
  EXPECT_LT((T_left_right.translation() - Vector3(0.54, 0, 0)).norm(), 1e-12);
}

TEST_F(KittiCalibration, PutsTheBodyInVehicleAxesAtTheLeftCamera) {
  const auto rig = load(std::string(kP0) + kP1);
  ASSERT_TRUE(rig) << rig.error().message;
  const Vector3 ahead_body = rig->T_body_rawleft * Vector3(0, 0, 1);
  EXPECT_LT((ahead_body - Vector3(1, 0, 0)).norm(), 1e-12);
  const Vector3 right_camera_body = rig->T_body_rawright * Vector3(0, 0, 0);
  EXPECT_LT((right_camera_body - Vector3(0, -0.54, 0)).norm(), 1e-12);
}

TEST_F(KittiCalibration, SubtractsTheOffsetOfTheLeftCamera) {
  const auto rig = load(std::string("P0: 700 0 600 70 0 700 180 0 0 0 1 0\n") + kP1);
  ASSERT_TRUE(rig) << rig.error().message;
  const Se3 T_left_right = rig->T_body_rawleft.inverse() * rig->T_body_rawright;
  EXPECT_NEAR(T_left_right.translation().x(), 0.64, 1e-12);
}

TEST_F(KittiCalibration, ReadsWindowsLineEnds) {
  const auto rig = load(
      "P0: 700 0 600 0 0 700 180 0 0 0 1 0\r\nP1: 700 0 600 -378 0 700 180 0 0 0 "
      "1 0\r\n");
  EXPECT_TRUE(rig) << rig.error().message;
}

TEST_F(KittiCalibration, RefusesAMissingFile) {
  const auto rig = load_kitti_calibration(folder_ / "absent.txt", 1226, 370);
  ASSERT_FALSE(rig.has_value());
  EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(rig.error().message, HasSubstr("absent.txt"));
  EXPECT_THAT(rig.error().message, HasSubstr("No such file"));
}

TEST_F(KittiCalibration, NamesTheMissingRow) {
  expect_refused(kP0, {"'P1'", "not found"});
}

TEST_F(KittiCalibration, SaysThatColourCamerasAreNotTheGreyOnes) {
  expect_refused("P2: 700 0 600 0 0 700 180 0 0 0 1 0\nP3: 700 0 600 0 0 700 180 0 0 0 1 0\n",
                 {"'P0'", "grey cameras", "P2 and P3"});
}

TEST_F(KittiCalibration, SaysLineAndCountOfAShortRow) {
  expect_refused(std::string(kP0) + "P1: 700 0 600\n", {":2:", "'P1'", "3 numbers", "12 numbers"});
}

TEST_F(KittiCalibration, ShowsWhatIsNoNumber) {
  expect_refused("P0: 700 0 6OO 0 0 700 180 0 0 0 1 0\n", {":1:", "'P0'", "'6OO'"});
}

TEST_F(KittiCalibration, RefusesNotANumberAndInfinity) {
  expect_refused("P0: nan 0 600 0 0 700 180 0 0 0 1 0\n", {":1:", "'nan'"});
  expect_refused("P0: 700 0 inf 0 0 700 180 0 0 0 1 0\n", {":1:", "'inf'"});
}

TEST_F(KittiCalibration, RefusesAFocalLengthOfZero) {
  expect_refused("P0: 0 0 600 0 0 700 180 0 0 0 1 0\n", {":1:", "focal length"});
}

TEST_F(KittiCalibration, RefusesFocalLengthsThatDiffer) {
  expect_refused(std::string(kP0) + "P1: 710 0 600 -378 0 700 180 0 0 0 1 0\n",
                 {":2:", "focal length 710", "700"});
}

TEST_F(KittiCalibration, RefusesRowsThatDoNotMatch) {
  expect_refused(std::string(kP0) + "P1: 700 0 600 -378 0 700 190 0 0 0 1 0\n", {":2:", "cy 190"});
}

TEST_F(KittiCalibration, RefusesAMatrixThatIsNotRectified) {
  expect_refused("P0: 700 3 600 0 0 700 180 0 0 0 1 0\n", {":1:", "rectified"});
}

TEST_F(KittiCalibration, RefusesABaselineOfZero) {
  expect_refused(std::string(kP0) + "P1: 700 0 600 0 0 700 180 0 0 0 1 0\n", {":2:", "baseline"});
}

TEST_F(KittiCalibration, NamesSwappedEyes) {
  expect_refused(std::string(kP0) + "P1: 700 0 600 378 0 700 180 0 0 0 1 0\n", {":2:", "swapped"});
}

TEST_F(KittiCalibration, RefusesAnAbsurdBaseline) {
  expect_refused(std::string(kP0) + "P1: 700 0 600 -37800 0 700 180 0 0 0 1 0\n",
                 {":2:", "baseline"});
}

}  // namespace
}  // namespace darkling::test
