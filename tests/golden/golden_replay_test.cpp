// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "support/golden_trajectory.h"

namespace darkling {
namespace {

using test::read_json;
using test::read_text;

// A short synthetic run through the whole program.
class EachScene : public ::testing::TestWithParam<std::string> {
 protected:
  test::ProgramResult replay(const std::string& source, const std::string& path,
                             const std::string& kernels = "auto") const {
    return test::run_darkling({"replay", source, "--width", "200", "--trajectory", path, "--stats",
                               stats_, "--kernels", kernels});
  }

  test::TemporaryFolder folder_;
  std::string stats_ = folder_ / "stats.json";
};

TEST_P(EachScene, GivesTheGoldenTrajectoryAndStaysNearTheTruth) {
  const auto run =
      replay("synthetic:" + GetParam() + ",frames=60,width=200", folder_ / "trajectory.txt");
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json stats = read_json(stats_);
  EXPECT_TRUE(test::is_golden(GetParam(), folder_ / "trajectory.txt"));
  EXPECT_EQ(stats["frames"], 60);
  EXPECT_EQ(stats["lost_frames"], 0);
  EXPECT_EQ(stats["resets"], 0);
  EXPECT_GT(stats["distance_m"], 1.0);
  EXPECT_LT(stats["ate_rmse_m"], 0.015);
  EXPECT_LT(stats["rpe_rmse_m"], 0.003);
  EXPECT_LT(stats["rpe_rmse_deg"], 0.08);
}

// Rendered once: that takes longer than all runs together, by far under emulation. That it gives
// the same images each time is the business of the source's own tests.
TEST_P(EachScene, GivesTheSameBytesOnEveryRunAndWithEveryKernel) {
  const std::string recording = folder_ / "recording";
  const auto render =
      test::run_darkling({"render", GetParam(), recording, "--frames", "24", "--width", "200"});
  ASSERT_EQ(render.status, 0) << render.err;
  const auto once = replay(recording, folder_ / "first.txt");
  ASSERT_EQ(once.status, 0) << once.err;
  const std::string first = read_text(folder_ / "first.txt");
  const nlohmann::json stats = read_json(stats_);
  EXPECT_GE(stats["keyframes"], 3) << "the run is too short to tell";
  for (const char* kernels : {"auto", "ref", "sse41", "avx2", "neon"}) {
    SCOPED_TRACE(kernels);
    const std::string path = folder_ / kernels;
    const auto run = replay(recording, path, kernels);
    if (run.status == 64 && run.err.find("not available") != std::string::npos) continue;
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read_text(path), first);
    EXPECT_EQ(read_json(stats_)["trajectory_sha256"], stats["trajectory_sha256"]);
  }
}

INSTANTIATE_TEST_SUITE_P(Golden, EachScene, ::testing::Values("mine", "quarry", "corridor"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace darkling
