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

constexpr const char* kBodyLeft =
    "  T_cam_imu:\n  - [0, -1, 0, 0]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, 0]\n  - [0, 0, 0, 1]\n";

double distance(const Se3& a, const Se3& b) {
  return minus(a, b).norm();
}

class KalibrCalibration : public ::testing::Test {
 protected:
  void SetUp() override { write_text(path_, tiny_camchain()); }

  void expect_refused(const char* from, const char* to, std::initializer_list<const char*> words) {
    replace_in_file(path_, from, to);
    const auto rig = load_kalibr_calibration(path_);
    ASSERT_FALSE(rig.has_value());
    EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
    EXPECT_THAT(rig.error().message, HasSubstr(path_));
    for (const char* word : words) EXPECT_THAT(rig.error().message, HasSubstr(word));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "camchain.yaml";
};

TEST_F(KalibrCalibration, SaysTheSameAsTheSensorFilesOfTheSameRig) {
  write_tiny_euroc(folder_.path(), {.frames = 1});
  const auto euroc = load_euroc_calibration(folder_ / "mav0");
  const auto kalibr = load_kalibr_calibration(path_);
  ASSERT_TRUE(euroc) << euroc.error().message;
  ASSERT_TRUE(kalibr) << kalibr.error().message;
  EXPECT_LT(distance(euroc->T_body_rawleft, kalibr->T_body_rawleft), 1e-12);
  EXPECT_LT(distance(euroc->T_body_rawright, kalibr->T_body_rawright), 1e-12);
  EXPECT_EQ(euroc->left.fx, kalibr->left.fx);
  EXPECT_EQ(euroc->right.cy, kalibr->right.cy);
  EXPECT_EQ(euroc->right.width, kalibr->right.width);
  EXPECT_EQ(euroc->left.distortion, kalibr->left.distortion);
}

TEST_F(KalibrCalibration, PutsTheBodyInVehicleAxesAtTheLeftCameraWithoutAnImu) {
  replace_in_file(path_, kBodyLeft, "");
  const auto rig = load_kalibr_calibration(path_);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_LT(distance(rig->T_body_rawleft, Se3(R_vehicle_optical(), Vector3::Zero())), 1e-12);
  EXPECT_LT((rig->T_body_rawright.translation() - Vector3(0, -0.1, 0)).norm(), 1e-12);
}

TEST_F(KalibrCalibration, PlacesTheRightCameraByItsOwnImuMotionToo) {
  const auto before = load_kalibr_calibration(path_);
  ASSERT_TRUE(before) << before.error().message;
  replace_in_file(path_, "T_cn_cnm1:\n  - [1, 0, 0, -0.1]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]",
                  "T_cam_imu:\n  - [0, -1, 0, -0.1]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, 0]");
  const auto after = load_kalibr_calibration(path_);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_LT(distance(before->T_body_rawright, after->T_body_rawright), 1e-12);
}

TEST_F(KalibrCalibration, TakesAPinholeWithoutCoefficients) {
  replace_in_file(path_, "radtan\n  distortion_coeffs: [0, 0, 0, 0]",
                  "none\n  distortion_coeffs: []");
  EXPECT_TRUE(load_kalibr_calibration(path_));
}

TEST_F(KalibrCalibration, TakesBothNamesOfTheEquidistantModel) {
  for (const char* name : {"equidistant", "equi"}) {
    write_text(path_, tiny_camchain());
    replace_in_file(path_, "radtan", name);
    const auto rig = load_kalibr_calibration(path_);
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->left.distortion, Distortion::kEquidistant);
  }
}

TEST_F(KalibrCalibration, RefusesAChainOfOneCamera) {
  expect_refused("cam1:", "camera1:", {"'cam1'", "nothing"});
}

TEST_F(KalibrCalibration, NamesTheMissingMotionBetweenTheCameras) {
  expect_refused("T_cn_cnm1", "T_other", {"'cam1.T_cn_cnm1'", "T_cam_imu"});
}

TEST_F(KalibrCalibration, RefusesOtherCameraModelsByName) {
  expect_refused("pinhole", "omni", {":3:", "'cam0.camera_model'", "'omni'"});
}

TEST_F(KalibrCalibration, RefusesOtherDistortionModelsByName) {
  expect_refused("radtan", "fov", {":5:", "'cam0.distortion_model'", "'fov'", "radtan"});
}

TEST_F(KalibrCalibration, RefusesAMotionThatIsNoMatrix) {
  expect_refused("[1, 0, 0, -0.1]", "[1, 0, 0]", {"'cam1.T_cn_cnm1'", "15 numbers"});
  write_text(path_, tiny_camchain());
  expect_refused("[1, 0, 0, -0.1]", "[1, 0, zero, -0.1]", {"'cam1.T_cn_cnm1'", "'zero'"});
}

TEST_F(KalibrCalibration, NamesSwappedEyes) {
  expect_refused("-0.1", "0.1", {"swapped"});
}

TEST_F(KalibrCalibration, RefusesABaselineOfZero) {
  expect_refused("-0.1", "0", {"baseline"});
}

TEST_F(KalibrCalibration, RefusesAnAbsurdBaseline) {
  expect_refused("-0.1", "-60", {"baseline"});
}

}  // namespace
}  // namespace darkling::test
