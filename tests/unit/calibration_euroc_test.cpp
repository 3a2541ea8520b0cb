// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/calibration.h"
#include "support/recordings.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

class EurocCalibration : public ::testing::Test {
 protected:
  void SetUp() override { write_tiny_euroc(folder_.path(), {.frames = 1}); }

  // Expects that the calibration is refused after `from` became `to` in cam1/sensor.yaml.
  void expect_refused(const char* from, const char* to, std::initializer_list<const char*> words) {
    replace_in_file(sensor1_, from, to);
    const auto rig = load_euroc_calibration(mav0_);
    ASSERT_FALSE(rig.has_value());
    EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
    EXPECT_THAT(rig.error().message, HasSubstr(sensor1_));
    for (const char* word : words) EXPECT_THAT(rig.error().message, HasSubstr(word));
  }

  TemporaryFolder folder_;
  std::string mav0_ = folder_ / "mav0";
  std::string sensor1_ = mav0_ + "/cam1/sensor.yaml";
};

TEST_F(EurocCalibration, ReadsBothCameras) {
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->left.width, 96);
  EXPECT_EQ(rig->left.height, 64);
  EXPECT_EQ(rig->left.fx, 96.0);
  EXPECT_EQ(rig->right.cx, 47.5);
  EXPECT_EQ(rig->right.distortion, Distortion::kRadTan);
  EXPECT_LT((rig->T_body_rawright.translation() - Vector3(0, -0.1, 0)).norm(), 1e-12);
  const Vector3 ahead_body = rig->T_body_rawleft * Vector3(0, 0, 1);
  EXPECT_LT((ahead_body - Vector3(1, 0, 0)).norm(), 1e-12);
}

TEST_F(EurocCalibration, ReadsARealRecording) {
  REQUIRE_RECORDING(recording, "euroc_mh01_a");
  const auto rig = load_euroc_calibration(recording + "/mav0");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->left.fx, 458.654);
  EXPECT_EQ(rig->right.coefficients[3], -3.55590700e-05);
  const Se3 T_left_right = rig->T_body_rawleft.inverse() * rig->T_body_rawright;
  EXPECT_NEAR(T_left_right.translation().x(), 0.110, 1e-3);
  EXPECT_LT((rig->T_body_rawleft.translation() - Vector3(-0.0216, -0.0647, 0.0098)).norm(), 1e-3);
}

TEST_F(EurocCalibration, TakesTheDistortionModelsAndTheirNames) {
  replace_in_file(sensor1_, "radial-tangential", "equidistant");
  ASSERT_TRUE(load_euroc_calibration(mav0_));
  EXPECT_EQ(load_euroc_calibration(mav0_)->right.distortion, Distortion::kEquidistant);
  replace_in_file(sensor1_, "equidistant", "none");
  ASSERT_TRUE(load_euroc_calibration(mav0_));
  EXPECT_EQ(load_euroc_calibration(mav0_)->right.distortion, Distortion::kNone);
}

TEST_F(EurocCalibration, TakesTheDirectiveThatOpenCvWrites) {
  write_text(sensor1_, "%YAML:1.0\n" + read_text(sensor1_));
  EXPECT_TRUE(load_euroc_calibration(mav0_));
}

TEST_F(EurocCalibration, MakesARotationOfFewDigitsOrthonormal) {
  replace_in_file(sensor1_, "[0, 0, 1, 0", "[0.0004, 0, 1, 0");
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_TRUE(rig) << rig.error().message;
  const Matrix3 R = rig->T_body_rawright.R();
  EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-12);
}

TEST_F(EurocCalibration, RefusesAMissingFile) {
  remove_path(sensor1_);
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_FALSE(rig.has_value());
  EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(rig.error().message, HasSubstr(sensor1_));
}

TEST_F(EurocCalibration, SaysWhereTheYamlIsBroken) {
  expect_refused("rate_hz: 20", "rate_hz: [20", {"sensor.yaml:", "YAML"});
}

TEST_F(EurocCalibration, RefusesAFileThatIsNoMap) {
  write_text(sensor1_, "just words\n");
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_FALSE(rig.has_value());
  EXPECT_THAT(rig.error().message, HasSubstr("map"));
}

TEST_F(EurocCalibration, NamesAMissingKey) {
  expect_refused("intrinsics:", "intrinsic:", {"'intrinsics'", "nothing", "[fx, fy, cx, cy]"});
}

TEST_F(EurocCalibration, RefusesOtherCameraModelsByName) {
  expect_refused("pinhole", "omni", {":12:", "'camera_model'", "'omni'", "pinhole"});
}

TEST_F(EurocCalibration, SuggestsTheNearestDistortionModel) {
  expect_refused("radial-tangential", "radial-tangent",
                 {":14:", "'distortion_model'", "did you mean 'radial-tangential'"});
}

TEST_F(EurocCalibration, CountsTheCoefficients) {
  expect_refused("distortion_coefficients: [0, 0, 0, 0]",
                 "distortion_coefficients: [0, 0, 0, 0, 0]",
                 {":15:", "'distortion_coefficients'", "5 numbers", "4 finite numbers"});
}

TEST_F(EurocCalibration, RefusesCoefficientsOfNoDistortion) {
  replace_in_file(sensor1_, "radial-tangential", "none");
  expect_refused("distortion_coefficients: [0, 0", "distortion_coefficients: [0.1, 0",
                 {":15:", "not zero"});
}

TEST_F(EurocCalibration, RefusesANumberThatIsNotFinite) {
  expect_refused("intrinsics: [96", "intrinsics: [.nan", {":13:", "'intrinsics'", "'.nan'"});
  replace_in_file(sensor1_, ".nan", "1e999");
  EXPECT_FALSE(load_euroc_calibration(mav0_));
}

TEST_F(EurocCalibration, RefusesANegativeFocalLength) {
  expect_refused("intrinsics: [96", "intrinsics: [-96", {":13:", "'intrinsics'", "-96"});
}

TEST_F(EurocCalibration, RefusesASizeOfZero) {
  expect_refused("resolution: [96, 64]", "resolution: [96, 0]", {":11:", "'resolution'"});
}

TEST_F(EurocCalibration, RefusesEyesOfDifferentSizes) {
  replace_in_file(sensor1_, "resolution: [96, 64]", "resolution: [96, 60]");
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_FALSE(rig.has_value());
  EXPECT_THAT(rig.error().message, HasSubstr("96x64"));
  EXPECT_THAT(rig.error().message, HasSubstr("96x60"));
}

TEST_F(EurocCalibration, RefusesAMatrixThatIsNoRotation) {
  expect_refused("[0, 0, 1, 0", "[0, 0, 1.1, 0", {"'T_BS'", "no rotation"});
}

TEST_F(EurocCalibration, RefusesAMirroredRotation) {
  expect_refused("[0, 0, 1, 0", "[0, 0, -1, 0", {"'T_BS'", "no rotation", "determinant -1"});
}

TEST_F(EurocCalibration, RefusesALastRowThatIsNot0001) {
  expect_refused("0, 0, 0, 1]", "0, 0, 0, 2]", {"'T_BS'", "last row 0 0 0 2"});
}

TEST_F(EurocCalibration, RefusesAMatrixOfNineNumbers) {
  expect_refused("0, -1, 0, 0,\n", "\n", {"'T_BS'", "12 numbers", "16 numbers"});
}

TEST_F(EurocCalibration, NamesSwappedEyes) {
  replace_in_file(sensor1_, "-0.1", "0.1");
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_FALSE(rig.has_value());
  EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(rig.error().message, HasSubstr(mav0_));
  EXPECT_THAT(rig.error().message, HasSubstr("swapped"));
}

TEST_F(EurocCalibration, RefusesABaselineOfZero) {
  replace_in_file(sensor1_, "-0.1", "0");
  const auto rig = load_euroc_calibration(mav0_);
  ASSERT_FALSE(rig.has_value());
  EXPECT_THAT(rig.error().message, HasSubstr("baseline"));
}

TEST_F(EurocCalibration, IsChosenFromSensorFilesBeforeACamchain) {
  write_text(folder_ / "camchain.yaml", tiny_camchain());
  const auto choice = choose_euroc_calibration(folder_.path());
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_FALSE(choice->is_kalibr);
  EXPECT_EQ(choice->path, mav0_);
}

TEST_F(EurocCalibration, IsChosenFromACamchainWhereASensorFileHasNoIntrinsics) {
  write_text(sensor1_, "sensor_type: camera\n");
  write_text(folder_ / "camchain.yaml", tiny_camchain());
  const auto choice = choose_euroc_calibration(folder_.path());
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_TRUE(choice->is_kalibr);
  EXPECT_EQ(choice->path, folder_ / "camchain.yaml");
}

TEST_F(EurocCalibration, IsFoundInTheFolderDsoAndByAnyCamchainName) {
  remove_path(sensor1_);
  for (const char* place :
       {"dso/camchain.yaml", "camchain-imucam-lab.yaml", "mav0/camchain.yaml"}) {
    write_text(folder_ / place, tiny_camchain());
    const auto choice = choose_euroc_calibration(folder_.path());
    ASSERT_TRUE(choice) << choice.error().message;
    EXPECT_EQ(choice->path, folder_ / place);
    remove_path(folder_ / place);
  }
}

TEST_F(EurocCalibration, IsNotGuessedAmongSeveralCamchains) {
  remove_path(sensor1_);
  write_text(folder_ / "camchain-a.yaml", tiny_camchain());
  write_text(folder_ / "camchain-b.yaml", tiny_camchain());
  const auto choice = choose_euroc_calibration(folder_.path());
  ASSERT_FALSE(choice.has_value());
  EXPECT_EQ(choice.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(choice.error().message, HasSubstr("camchain-a.yaml"));
  EXPECT_THAT(choice.error().message, HasSubstr("camchain-b.yaml"));
}

TEST_F(EurocCalibration, SaysWhereItWasLookedForWhenThereIsNone) {
  remove_path(sensor1_);
  const auto choice = choose_euroc_calibration(folder_.path());
  ASSERT_FALSE(choice.has_value());
  EXPECT_EQ(choice.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(choice.error().message, HasSubstr("mav0/cam1/sensor.yaml"));
  EXPECT_THAT(choice.error().message, HasSubstr("camchain"));
}

}  // namespace
}  // namespace darkling::test
