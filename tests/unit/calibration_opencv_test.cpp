// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/frames.h"
#include "io/calibration.h"
#include "support/calibration_files.h"
#include "support/example_rigs.h"
#include "support/temporary_folder.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

constexpr ImageSize kSize{.width = 640, .height = 480};

class OpencvCalibration : public ::testing::Test {
 protected:
  OpencvCalibration() {
    write_text(intrinsics_, opencv_intrinsics());
    write_text(extrinsics_, opencv_extrinsics());
  }

  Result<StereoRig> load() { return load_opencv_calibration(intrinsics_, extrinsics_, kSize); }

  // After `from` became `to` in `path`; the files are as before afterwards.
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
  std::string intrinsics_ = folder_ / "intrinsics.yml";
  std::string extrinsics_ = folder_ / "extrinsics.yml";
};

TEST_F(OpencvCalibration, ReadsEveryNumber) {
  const auto rig = load();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->left.width, 640);
  EXPECT_EQ(rig->right.height, 480);
  EXPECT_EQ(rig->left.fx, 500.0);
  EXPECT_EQ(rig->left.fy, 501.0);
  EXPECT_EQ(rig->right.cx, 322.0);
  EXPECT_EQ(rig->right.cy, 242.0);
  EXPECT_EQ(rig->left.distortion, Distortion::kRadTan);
  EXPECT_THAT(rig->left.coefficients, ::testing::ElementsAre(-0.2, 0.05, 1e-3, -1e-3));
  EXPECT_THAT(rig->right.coefficients, ::testing::ElementsAre(-0.21, 0.06, 2e-3, -2e-3));
}

// p_right = R p_left + T, and not the other way round.
TEST_F(OpencvCalibration, TakesRAndTFromLeftToRight) {
  const auto rig = load();
  ASSERT_TRUE(rig) << rig.error().message;
  const Se3 T_right_left = rig->T_body_rawright.inverse() * rig->T_body_rawleft;
  EXPECT_LT((T_right_left * Vector3::Zero() - Vector3(-0.12, 0.001, 0.002)).norm(), 1e-12);
  const Vector3 ahead = T_right_left * Vector3(0, 0, 1) - T_right_left * Vector3::Zero();
  EXPECT_LT((ahead - Vector3(0.0174524064, 0, 0.9998476952)).norm(), 1e-9);
}

TEST_F(OpencvCalibration, PutsTheBodyInVehicleAxesAtTheLeftCamera) {
  const auto rig = load();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_LT(minus(rig->T_body_rawleft, Se3(R_vehicle_optical(), Vector3::Zero())).norm(), 1e-12);
}

TEST_F(OpencvCalibration, ReadsBackARigThatOpencvItselfWrote) {
  for (const StereoRig& written : {euroc_rig(), fisheye_rig(), toed_in_rig(), upside_down_rig()}) {
    write_text(folder_ / "stereo.yml", opencv_calibration(written));
    const auto rig = load_calibration(folder_ / "stereo.yml");
    ASSERT_TRUE(rig) << rig.error().message;
    StereoRig expected = written;
    for (Camera* camera : {&expected.left, &expected.right}) {
      if (camera->distortion == Distortion::kNone) camera->distortion = Distortion::kRadTan;
    }
    expect_same_pair(*rig, expected, 1e-12);
  }
}

TEST_F(OpencvCalibration, TakesTheOtherNamesOfItsKeys) {
  replace_in_file(intrinsics_, "M1:", "cameraMatrix1:");
  replace_in_file(intrinsics_, "D1:", "distCoeffs1:");
  replace_in_file(intrinsics_, "M2:", "K2:");
  EXPECT_TRUE(load());
}

TEST_F(OpencvCalibration, TakesTheSizeFromTheFileBeforeThatOfTheImages) {
  for (const char* text : {"image_width: 800\nimage_height: 600\n", "imageSize: [ 800, 600 ]\n",
                           "image_size: [800, 600]\n"}) {
    write_text(intrinsics_, opencv_intrinsics() + text);
    const auto rig = load();
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->left.width, 800);
    EXPECT_EQ(rig->right.height, 600);
  }
}

TEST_F(OpencvCalibration, RefusesAFileThatSaysNoSizeWhereNothingElseDoes) {
  const auto rig = load_opencv_calibration(intrinsics_, extrinsics_, std::nullopt);
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(rig.error().message, HasSubstr("'image_width': found nothing"));
}

TEST_F(OpencvCalibration, RefusesASizeThatIsNone) {
  for (const char* text : {"image_width: 800\n", "image_width: 0\nimage_height: 600\n",
                           "image_width: 80.5\nimage_height: 600\n", "imageSize: [800]\n",
                           "imageSize: [1e9, 600]\n", "imageSize: 800x600\n"}) {
    write_text(intrinsics_, opencv_intrinsics() + text);
    const auto rig = load();
    ASSERT_FALSE(rig) << text;
    EXPECT_THAT(rig.error().message, HasSubstr("allowed is"));
  }
}

TEST_F(OpencvCalibration, NamesSwappedEyes) {
  expect_refused(extrinsics_, "-0.12", "0.12", {":9: keys 'R' and 'T'", "swapped"});
}

TEST_F(OpencvCalibration, SuspectsMillimetresOrSquares) {
  expect_refused(extrinsics_, "-0.12, 0.001, 0.002", "-120, 1, 2",
                 {"baseline of 120", "metres", "in mm", "squares of the board"});
}

TEST_F(OpencvCalibration, RefusesARotationThatIsNone) {
  expect_refused(extrinsics_, "0., 1., 0.", "0., 2., 0.", {"'R'", "no rotation"});
  expect_refused(extrinsics_, "0., 1., 0.", "0., -1., 0.", {"'R'", "no rotation"});
}

TEST_F(OpencvCalibration, RefusesMatricesOfOtherShapes) {
  expect_refused(extrinsics_, "rows: 3\n   cols: 1", "rows: 1\n   cols: 2", {"'T'", "1x2"});
  expect_refused(extrinsics_, "-0.12, 0.001, 0.002", "-0.12, 0.001", {"'T'", "2 numbers", "3x1"});
  expect_refused(intrinsics_, "500., 0., 320.", "500., 320.", {"'M1'", "8 numbers", "3x3"});
  expect_refused(intrinsics_, "cols: 3", "cols: three", {"'M1'", "no rows and cols"});
  expect_refused(intrinsics_, "data: [ 500.", "values: [ 500.", {"'M1'", "a map without data"});
}

TEST_F(OpencvCalibration, RefusesSkewAndFocalLengthsThatAreNone) {
  expect_refused(intrinsics_, "500., 0., 320.", "500., 3., 320.", {"'M1'", "no pinhole"});
  expect_refused(intrinsics_, "500., 0., 320.", "-500., 0., 320.", {"'M1'", "focal lengths -500"});
}

TEST_F(OpencvCalibration, RefusesCoefficientsThatTheLensModelLacks) {
  expect_refused(intrinsics_, "-1e-3, 0. ]", "-1e-3, 0.1 ]", {"'D1'", "k3 = 0.1", "CALIB_FIX_K3"});
  expect_refused(intrinsics_, "[ -0.21, 0.06, 2e-3, -2e-3, 0. ]", "[ -0.21, 0.06 ]", {"'D2'"});
}

TEST_F(OpencvCalibration, RefusesWhatIsNoNumber) {
  expect_refused(intrinsics_, "500.,", ".Nan,", {"'M1'", "'.Nan' among the numbers"});
  expect_refused(intrinsics_, "500.,", "1e999,", {"'M1'", "'1e999' among the numbers"});
  expect_refused(extrinsics_, "-0.12", "-1e308", {"baseline"});
}

TEST_F(OpencvCalibration, NamesTheMissingKey) {
  expect_refused(intrinsics_, "M2:", "M3:", {"'M2'", "nothing"});
  expect_refused(intrinsics_, "D2:", "D3:", {"'D2'", "nothing"});
  expect_refused(extrinsics_, "T:", "S:", {"'T'", "nothing"});
  expect_refused(extrinsics_, "R:", "S:", {"'R'", "nothing"});
}

TEST_F(OpencvCalibration, RefusesModelsItDoesNotKnow) {
  write_text(intrinsics_, opencv_intrinsics() + "distortion_model: omni\n");
  const auto rig = load();
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message, HasSubstr("'distortion_model': found 'omni'"));
  write_text(intrinsics_, opencv_intrinsics() + "fisheye_model: yes\n");
  EXPECT_FALSE(load());
}

}  // namespace
}  // namespace darkling::test
