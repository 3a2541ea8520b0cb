// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/calibration.h"
#include "support/calibration_files.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

constexpr ImageSize kSize{.width = 640, .height = 480};
constexpr const char* kKitti =
    "P0: 500 0 320 0 0 500 240 0 0 0 1 0\nP1: 500 0 320 -60 0 500 240 0 0 0 1 0\n";

class LoadCalibration : public ::testing::Test {
 protected:
  // The distance of the eyes that `path` says; fails when it does not load.
  static double baseline_m(const std::string& path, std::optional<ImageSize> size = std::nullopt) {
    const auto rig = load_calibration(path, size);
    EXPECT_TRUE(rig) << path << " -> " << rig.error().message;
    if (!rig) return 0.0;
    return (rig->T_body_rawleft.inverse() * rig->T_body_rawright).translation().norm();
  }

  static void expect_refused(const std::string& path, const char* part) {
    const auto rig = load_calibration(path);
    ASSERT_FALSE(rig.has_value());
    EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
    EXPECT_THAT(rig.error().message, HasSubstr(path));
    EXPECT_THAT(rig.error().message, HasSubstr(part));
  }

  TemporaryFolder folder_;
};

TEST_F(LoadCalibration, RecognisesAKalibrCamchainByWhateverName) {
  write_text(folder_ / "rover.txt", tiny_camchain());
  EXPECT_NEAR(baseline_m(folder_ / "rover.txt"), TinyDataset::kBaseline_m, 1e-9);
}

TEST_F(LoadCalibration, RecognisesTheFolderOfTheOnlyCamchain) {
  write_text(folder_ / "camchain-rover.yaml", tiny_camchain());
  EXPECT_NEAR(baseline_m(folder_.path()), TinyDataset::kBaseline_m, 1e-9);
  write_text(folder_ / "camchain-other.yaml", tiny_camchain());
  expect_refused(folder_.path(), "which calibration is meant?");
}

TEST_F(LoadCalibration, RecognisesEurocByEachOfItsFolders) {
  write_tiny_euroc(folder_.path(), {.frames = 1});
  for (const char* name : {"", "mav0", "mav0/", "mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml"}) {
    EXPECT_NEAR(baseline_m(folder_ / name), TinyDataset::kBaseline_m, 1e-9) << name;
  }
  std::filesystem::rename(folder_ / "mav0", folder_ / "rig");
  EXPECT_NEAR(baseline_m(folder_ / "rig"), TinyDataset::kBaseline_m, 1e-9);
}

TEST_F(LoadCalibration, RecognisesKittiAndNeedsTheSizeOfItsImages) {
  write_text(folder_ / "calib.txt", kKitti);
  EXPECT_NEAR(baseline_m(folder_ / "calib.txt", kSize), 0.12, 1e-9);
  EXPECT_NEAR(baseline_m(folder_.path(), kSize), 0.12, 1e-9);
  expect_refused(folder_ / "calib.txt", "does not say the size");
}

TEST_F(LoadCalibration, RecognisesOpencvInOneFileOrTwo) {
  write_text(folder_ / "one.yml", opencv_intrinsics() + "imageSize: [ 640, 480 ]\n" +
                                      opencv_extrinsics().substr(sizeof("%YAML:1.0\n---")));
  EXPECT_NEAR(baseline_m(folder_ / "one.yml"), 0.12, 1e-3);
  write_text(folder_ / "two/intrinsics.yml", opencv_intrinsics());
  write_text(folder_ / "two/extrinsics.yml", opencv_extrinsics());
  for (const char* name : {"two", "two/intrinsics.yml", "two/extrinsics.yml"}) {
    EXPECT_NEAR(baseline_m(folder_ / name, kSize), 0.12, 1e-3) << name;
  }
  expect_refused(folder_ / "two", "image_width and image_height");
}

// As cv::stereoRectify's results lie beside R and T: P1 is a key of theirs and of KITTI's.
TEST_F(LoadCalibration, TellsOpencvFromKittiByWhatFollowsP1) {
  write_text(folder_ / "one.yml",
             opencv_intrinsics() + "imageSize: [ 640, 480 ]\n" +
                 opencv_extrinsics().substr(sizeof("%YAML:1.0\n---")) +
                 "P1: !!opencv-matrix\n   rows: 1\n   cols: 1\n   dt: d\n   data: [ 500. ]\n");
  EXPECT_NEAR(baseline_m(folder_ / "one.yml"), 0.12, 1e-3);
}

TEST_F(LoadCalibration, SaysWhichHalfOfOpencvsFilesIsMissing) {
  write_text(folder_ / "left_right.yml", opencv_intrinsics());
  expect_refused(folder_ / "left_right.yml", "M1 and M2 without R and T");
  write_text(folder_ / "pose.yml", opencv_extrinsics());
  expect_refused(folder_ / "pose.yml", "R and T without M1 and M2");
}

TEST_F(LoadCalibration, RecognisesRosByFolderFileOrPair) {
  write_text(folder_ / "left.yaml", ros_camera_info("left", 0.0));
  write_text(folder_ / "right.yaml", ros_camera_info("right", -60.0));
  for (const std::string& path : {folder_.path(), folder_ / "left.yaml", folder_ / "right.yaml",
                                  folder_ / "left.yaml," + folder_ / "right.yaml"}) {
    EXPECT_NEAR(baseline_m(path), 0.12, 1e-9) << path;
  }
  std::filesystem::rename(folder_ / "left.yaml", folder_ / "ost.yaml");
  expect_refused(folder_ / "ost.yaml", "camera_info of one camera");
}

TEST_F(LoadCalibration, RefusesWhatIsAbsentEmptyOrSomethingElse) {
  expect_refused(folder_ / "absent.yaml", "No such file");
  expect_refused(folder_.path(), "a folder without a calibration");
  write_text(folder_ / "empty.yaml", "");
  expect_refused(folder_ / "empty.yaml", "found nothing");
  write_text(folder_ / "other.yaml", "width_px: 320\n");
  expect_refused(folder_ / "other.yaml", "none of the keys");
  write_text(folder_ / "notes.txt", "cam0 is the left one");
  expect_refused(folder_ / "notes.txt", "map of keys is needed");
  write_text(folder_ / "huge.yaml", std::string((1 << 20) + 1, '#'));
  expect_refused(folder_ / "huge.yaml", "at most 1048576");
  expect_refused("/dev/zero", "it is no file");
  EXPECT_FALSE(load_calibration(""));
}

TEST_F(LoadCalibration, RefusesHostileYaml) {
  const std::string path = folder_ / "hostile.yaml";
  write_text(path, "M1: " + std::string(100000, '['));
  expect_refused(path, "not valid YAML");
  write_text(path, "M1: " + std::string(400, '[') + std::string(400, ']'));
  expect_refused(path, "M1 and M2 without");
  // Aliases of aliases: ten to the eighth elements, were they written out.
  std::string laughs = "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n";
  for (int i = 1; i < 8; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + alias;
    for (int k = 1; k < 10; ++k) laughs += "," + alias;
    laughs += "]\n";
  }
  write_text(path, laughs + "image_width: 640\nimage_height: 480\nM1: *a7\nR: *a7\n");
  expect_refused(path, "more than 64 elements");
  write_text(path, "image_width: 640\nimage_height: 480\nR: 1\nM1: &a [*a, *a]\n");
  expect_refused(path, "'M1'");
  write_text(path, "cam0: &c {camera_model: pinhole, resolution: *c}\ncam1: *c\n");
  expect_refused(path, "'cam0.resolution'");
  write_text(path, "? [1, 2]\n: 3\ncam0: [1]\n");
  expect_refused(path, "'cam0'");
}

}  // namespace
}  // namespace darkling::test
