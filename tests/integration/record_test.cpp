// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/framelog/frame_log.h"
#include "integration/darklingd.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kCamera = "camera=synthetic:corridor,frames=12,width=96";

TEST(Record, WritesALogThatTheServicePlays) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  const auto run = run_darkling({"record", path, "--set", kCamera, "--frames", "15"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, AllOf(StartsWith(path + ": 15 frames, 0 gaps, 0."),
                             HasSubstr(" a second, 0."), HasSubstr(" MB\n")));

  const auto log = open_frame_log(path);
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(describe_damage(*log), "");
  EXPECT_EQ(log->rows.size(), 15u);
  EXPECT_EQ(log->record.source, "synthetic:corridor,frames=12,width=96");
  EXPECT_THAT(log->record.config, HasSubstr("synthetic:corridor,frames=12,width=96"));

  // It ends with the recording.
  const test::OwnNetwork network;
  const auto played =
      test::run_program(test::darklingd_words(network, {"camera=" + path, "width_px=96"}));
  EXPECT_EQ(played.status, 0) << played.err;
  EXPECT_THAT(played.out + played.err, HasSubstr("state=TRACKING"));
}

TEST(Record, LeavesAWholeLogAfterControlC) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  test::RunningProgram program(test::darkling_words({"record", path, "--set", kCamera}));
  constexpr std::uintmax_t kSomeFrames = 100'000;  // bytes
  for (int i = 0; i < 4000; ++i) {
    if (std::filesystem::exists(path) && std::filesystem::file_size(path) > kSomeFrames) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  program.send_signal(SIGINT);
  const auto run = program.wait();
  EXPECT_EQ(run.status, 0) << run.err;  // without --frames it is the way to end it
  const auto log = open_frame_log(path);
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(describe_damage(*log), "");
  EXPECT_THAT(run.out, HasSubstr(": " + std::to_string(log->rows.size()) + " frames, 0 gaps"));
}

TEST(Record, LeavesNothingBehindWithoutACamera) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  const std::string calibration = folder / "camchain.yaml";
  test::write_text(
      calibration,
      "cam0:\n  camera_model: pinhole\n  intrinsics: [60, 60, 48, 32]\n"
      "  distortion_model: radtan\n  distortion_coeffs: [0, 0, 0, 0]\n"
      "  resolution: [96, 64]\n"
      "cam1:\n  T_cn_cnm1: [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"
      "  camera_model: pinhole\n  intrinsics: [60, 60, 48, 32]\n"
      "  distortion_model: radtan\n  distortion_coeffs: [0, 0, 0, 0]\n"
      "  resolution: [96, 64]\n");
  const std::string camera = "camera=v4l2:" + folder / "video0" + "," + folder / "video1";
  const auto run =
      run_darkling({"record", path, "--set", camera, "--set", "calibration=" + calibration});
  EXPECT_EQ(run.status, 69) << run.err;
  EXPECT_THAT(run.err, HasSubstr("video0"));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Record, WritesOverNothingUnlessForced) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  test::write_text(path, "precious");
  auto run = run_darkling({"record", path, "--set", kCamera, "--frames", "2"});
  EXPECT_EQ(run.status, 64);
  EXPECT_THAT(run.err, HasSubstr("--force"));
  EXPECT_EQ(test::read_text(path), "precious");
  run = run_darkling({"record", path, "--set", kCamera, "--frames", "2", "--force"});
  EXPECT_EQ(run.status, 0) << run.err;

  // Nor, in any case, over what it reads.
  run = run_darkling({"record", path, "--set", "camera=" + path, "--force"});
  EXPECT_EQ(run.status, 64);
  EXPECT_TRUE(open_frame_log(path));
}

TEST(Record, EndsWholeAtTheLimitOfItsSize) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  const auto run = run_darkling(
      {"record", path, "--set", "record_limit_mb=1", "--set", "rate_hz=240", "--set", kCamera});
  EXPECT_EQ(run.status, 64);
  const auto log = open_frame_log(path);
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(describe_damage(*log), "");
  EXPECT_LE(std::filesystem::file_size(path), 1'000'000u);
}

TEST(Record, RefusesWhatMakesNoSense) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  EXPECT_EQ(run_darkling({"record", path}).status, 78);  // no camera is configured
  EXPECT_EQ(run_darkling({"record", path, "--set", kCamera, "--frames", "0"}).status, 64);
  EXPECT_EQ(run_darkling({"record", path, "--set", kCamera, "--for", "0"}).status, 64);
  EXPECT_EQ(run_darkling({"record"}).status, 64);
}

}  // namespace
}  // namespace darkling
