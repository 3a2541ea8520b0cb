// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "io/trajectory.h"
#include "support/sanitized.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::read_json;
using test::read_text;
using test::run_darkling;
using ::testing::HasSubstr;

// A KITTI folder of small frames and a place for outputs.
class Replay : public ::testing::Test {
 protected:
  Replay() { test::write_tiny_kitti(kitti_, {.frames = kFrames}); }

  test::ProgramResult replay(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {"replay", kitti_, "--width", "96"};
    words.insert(words.end(), options.begin(), options.end());
    return run_darkling(words);
  }

  static constexpr int kFrames = 8;
  test::TemporaryFolder folder_;
  std::string kitti_ = folder_ / "kitti";
  std::string trajectory_ = folder_ / "trajectory.txt";
  std::string stats_ = folder_ / "stats.json";
};

TEST_F(Replay, PrintsATableAndNothingOnStandardError) {
  const auto run = replay({});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  for (const char* part : {"frames", "8:", "keyframes", "distance", "real time", "ATE", "RPE"}) {
    EXPECT_THAT(run.out, HasSubstr(part));
  }
}

TEST_F(Replay, WritesEveryFixedKeyOfTheStatistics) {
  ASSERT_EQ(replay({"--stats", stats_}).status, 0);
  const auto json = read_json(stats_);
  for (const char* key :
       {"frames",           "keyframes",    "lost_frames",   "resets",
        "distance_m",       "ate_rmse_m",   "drift_percent", "drift_deg_per_m",
        "rpe_rmse_m",       "rpe_rmse_deg", "nees_motion",   "nees_pose",
        "frame_ms",         "stage_us",     "arena_bytes",   "heap_calls_after_start",
        "peak_rss_bytes",   "kernels",      "width",         "height",
        "trajectory_sha256"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["frames"], kFrames);
  EXPECT_EQ(json["width"], 96);
  EXPECT_EQ(json["height"], 64);
  EXPECT_GE(json["keyframes"], 1);
  EXPECT_GT(json["frame_ms"]["p50"], 0.0);
  EXPECT_GT(json["stage_us"]["track"]["p50"], 0.0);
  EXPECT_GT(json["peak_rss_bytes"], 1 << 20);
  if (test::kIsSanitized) {
    EXPECT_TRUE(json["heap_calls_after_start"].is_null());
  } else {
    EXPECT_EQ(json["heap_calls_after_start"], 0);
  }
}

TEST_F(Replay, WritesAKittiRowAFrameFromTheIdentityOn) {
  ASSERT_EQ(replay({"--trajectory", trajectory_}).status, 0);
  const auto trajectory = read_trajectory(trajectory_);
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  EXPECT_EQ(trajectory->key, PoseKey::kRow);
  ASSERT_EQ(trajectory->poses.size(), static_cast<std::size_t>(kFrames));
  EXPECT_TRUE(trajectory->poses[0].T_world_pose.matrix().isIdentity(0.0));
}

TEST_F(Replay, WritesTumRowsWithTheStampsOfTheSource) {
  const std::string euroc = folder_ / "euroc";
  test::write_tiny_euroc(euroc, {.frames = 4});
  const auto run = run_darkling(
      {"replay", euroc, "--width", "96", "--trajectory", trajectory_, "--format", "tum"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto trajectory = read_trajectory(trajectory_);
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  ASSERT_EQ(trajectory->poses.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(to_ns(trajectory->poses[static_cast<std::size_t>(i)].stamp), test::euroc_stamp_ns(i));
  }
}

TEST_F(Replay, GivesTheSameBytesEveryTimeAndWithAnyKernels) {
  ASSERT_EQ(replay({"--trajectory", trajectory_, "--stats", stats_}).status, 0);
  const std::string bytes = read_text(trajectory_);
  const std::string sha256 = read_json(stats_)["trajectory_sha256"];
  EXPECT_EQ(sha256.size(), 64u);
  for (const char* kernels : {"auto", "ref"}) {
    ASSERT_EQ(replay({"--trajectory", trajectory_, "--stats", stats_, "--kernels", kernels}).status,
              0);
    EXPECT_EQ(read_text(trajectory_), bytes) << kernels;
    EXPECT_EQ(read_json(stats_)["trajectory_sha256"], sha256) << kernels;
  }
  EXPECT_EQ(read_json(stats_)["kernels"], "ref");
}

TEST_F(Replay, HashesTheKittiRowsWhateverIsWritten) {
  ASSERT_EQ(replay({"--stats", stats_}).status, 0);
  const std::string without_file = read_json(stats_)["trajectory_sha256"];
  ASSERT_EQ(replay({"--stats", stats_, "--trajectory", trajectory_, "--format", "tum"}).status, 0);
  EXPECT_EQ(read_json(stats_)["trajectory_sha256"], without_file);
  ASSERT_EQ(replay({"--trajectory", trajectory_}).status, 0);
  const auto sum = test::run_program({"/usr/bin/sha256sum", trajectory_});
  EXPECT_EQ(sum.out.substr(0, 64), without_file);
}

TEST_F(Replay, FindsTheErrorsThatEvalFinds) {
  ASSERT_EQ(replay({"--trajectory", trajectory_, "--stats", stats_}).status, 0);
  const auto run = run_darkling({"eval", "--json", kitti_ + "/poses.txt", trajectory_});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto in_run = read_json(stats_);
  const auto afterwards = nlohmann::json::parse(run.out);
  for (const char* key : {"ate_rmse_m", "rpe_rmse_m", "rpe_rmse_deg"}) {
    // A rotation goes through the file's digits: equal to rounding.
    EXPECT_NEAR(in_run[key].get<double>(), afterwards[key].get<double>(), 1e-12) << key;
  }
  EXPECT_TRUE(in_run["drift_percent"].is_null());  // a path of centimetres
}

TEST_F(Replay, ComparesThePartThatWasPlayedWithItsOwnTruth) {
  ASSERT_EQ(replay({"--frames", "1:8", "--stride", "2", "--stats", stats_}).status, 0);
  const auto json = read_json(stats_);
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["truth_poses"], 4);
  EXPECT_NEAR(json["truth_path_m"].get<double>(), 6 * test::TinyDataset().step_m(), 1e-6);
}

TEST_F(Replay, GoesOnPastADamagedImage) {
  test::truncate_file(kitti_ + "/image_1/" + test::kitti_image_name(3), 0.5);
  const auto run = replay({"--trajectory", trajectory_, "--stats", stats_});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("1 bad"));
  const auto json = read_json(stats_);
  EXPECT_EQ(json["frames"], kFrames);
  EXPECT_EQ(json["bad_frames"], 1);
  EXPECT_EQ(json["source_faults"]["unreadable"], 1);
  EXPECT_EQ(test::count_lines(read_text(trajectory_)), static_cast<std::size_t>(kFrames));
}

TEST_F(Replay, PlaysARenderedScene) {
  const auto run = run_darkling({"replay", "synthetic:corridor,frames=4,width=96,seed=2", "--width",
                                 "96", "--stats", stats_});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = read_json(stats_);
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["truth_poses"], 4);
}

TEST_F(Replay, TakesAsLongAsTheRecordingWhenAsked) {
  const auto started_at = std::chrono::steady_clock::now();
  ASSERT_EQ(replay({"--pace", "recorded"}).status, 0);
  const auto elapsed = std::chrono::steady_clock::now() - started_at;
  EXPECT_GE(elapsed, std::chrono::milliseconds(100) * (kFrames - 1));
}

}  // namespace
}  // namespace darkling
