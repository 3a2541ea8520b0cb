// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "io/trajectory.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;

// Waits until the file holds so many lines; a run that never writes them fails the test.
bool wait_for_lines(const std::string& path, std::size_t lines) {
  for (int i = 0; i < 2000; ++i) {
    if (std::filesystem::exists(path) && test::count_lines(test::read_text(path)) >= lines) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

void expect_whole_outputs_after(int signal_number) {
  const test::TemporaryFolder folder;
  const std::string kitti = folder / "kitti";
  const std::string trajectory_path = folder / "trajectory.txt";
  const std::string stats = folder / "stats.json";
  constexpr int kFrames = 400;  // 40 s at recorded pace: never reached
  test::write_tiny_kitti(kitti, {.frames = kFrames, .width = 96, .height = 64});

  test::RunningProgram program(
      test::darkling_words({"replay", kitti, "--width", "96", "--pace", "recorded", "--trajectory",
                            trajectory_path, "--stats", stats}));
  ASSERT_TRUE(wait_for_lines(trajectory_path, 4));
  program.send_signal(signal_number);
  const auto run = program.wait();

  EXPECT_EQ(run.status, 130);
  EXPECT_THAT(run.out, HasSubstr("(interrupted)"));
  const auto trajectory = read_trajectory(trajectory_path);
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  const auto json = test::read_json(stats);
  EXPECT_EQ(json["interrupted"], true);
  EXPECT_EQ(json["frames"], trajectory->poses.size());
  EXPECT_EQ(json["truth_poses"], trajectory->poses.size());
  EXPECT_LT(trajectory->poses.size(), static_cast<std::size_t>(kFrames));
}

TEST(Interrupt, LeavesWholeOutputsAfterControlC) {
  expect_whole_outputs_after(SIGINT);
}

TEST(Interrupt, LeavesWholeOutputsAfterTermination) {
  expect_whole_outputs_after(SIGTERM);
}

}  // namespace
}  // namespace darkling
