// SPDX-License-Identifier: Apache-2.0
// The fuzzers' targets for texts under random damage; tests/fuzz/run.sh searches for longer and
// better.
#include "support/hostile_text.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/config.h"
#include "support/calibration_texts.h"
#include "support/try_damaged.h"

namespace darkling::test {
namespace {

constexpr int kRounds = 1000;
const std::string kZero(1, '\0');

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// One for each way that files of a calibration may lie.
std::vector<std::string> calibrations() {
  return {kZero + kalibr_camchain(), kZero + kitti_calib(),
          "\1" + ros_camera_info("left", 0.0) + kZero + ros_camera_info("right", -60.0),
          "\2" + opencv_intrinsics() + kZero + opencv_extrinsics(),
          "\3" + euroc_sensor(0.05) + kZero + euroc_sensor(-0.06)};
}

const std::string kTum =
    "# stamp tx ty tz qx qy qz qw\n1403636579.763555527 0 0 0 0 0 0 1\n"
    "1403636579.813555 0.1 0 0 0 0 0.6 0.8\n1403636579.86 1 2 3 0 0 0 1\n";

TEST(HostileText, DoesNotBreakTheConfiguration) {
  try_damaged(bytes_of(format_config(Config{})), load_any_config, kRounds, 1);
}

TEST(HostileText, DoesNotBreakTheCalibrations) {
  std::uint32_t seed = 2;
  for (const std::string& text : calibrations()) {
    // Another test damages them more often.
    try_damaged(bytes_of(text), load_any_calibration, kRounds / 5, seed++);
  }
}

TEST(HostileText, DoesNotBreakTheTrajectories) {
  try_damaged(bytes_of(kTum), read_any_trajectory, kRounds, 10);
}

TEST(HostileText, DoesNotBreakTheWordsOfTheCommandLine) {
  std::uint32_t seed = 20;
  for (const char* word :
       {"v4l2:/dev/video0,/dev/video1", "libcamera:cam@10,1", "synthetic:mine,frames=20,seed=3",
        "electrons=5@10:20,seed=7", "width_px=177", "1403636584.66356"}) {
    try_damaged(bytes_of(word), understand_any_word, kRounds, seed++);
  }
}

// What is right is accepted: else the above would be about refusals only.
TEST(HostileText, IsToldFromASoundOne) {
  EXPECT_TRUE(load_any_config(bytes_of(format_config(Config{}))));
  EXPECT_FALSE(load_any_config(bytes_of("width_px: [")));
  for (const std::string& text : calibrations()) {
    EXPECT_TRUE(load_any_calibration(bytes_of(text))) << text;
  }
  EXPECT_FALSE(load_any_calibration(bytes_of("\3" + euroc_sensor(0.05))));
  EXPECT_EQ(read_any_trajectory(bytes_of(kTum)), 3u);
  EXPECT_EQ(read_any_trajectory(bytes_of("1 2 3\n")), 0u);
  for (const char* word : {"v4l2:/dev/video0", "libcamera:0", "synthetic:mine,frames=20",
                           "electrons=5", "width_px=177", "12.5", "b/cam@10"}) {
    EXPECT_EQ(understand_any_word(bytes_of(word)), 1) << word;
  }
  EXPECT_EQ(understand_any_word(bytes_of("no such thing")), 0);
}

}  // namespace
}  // namespace darkling::test
