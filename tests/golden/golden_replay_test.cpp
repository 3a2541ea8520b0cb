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
  // @return the statistics; the trajectory is in `path`.
  nlohmann::json replay(const std::string& path, const std::string& kernels = "auto") const {
    const auto run =
        test::run_darkling({"replay", "synthetic:" + GetParam() + ",frames=60,width=200", "--width",
                            "200", "--trajectory", path, "--stats", stats_, "--kernels", kernels});
    EXPECT_EQ(run.status, 0) << run.err;
    return read_json(stats_);
  }

  test::TemporaryFolder folder_;
  std::string stats_ = folder_ / "stats.json";
};

TEST_P(EachScene, GivesTheGoldenTrajectoryAndStaysNearTheTruth) {
  const nlohmann::json stats = replay(folder_ / "trajectory.txt");
  EXPECT_TRUE(test::is_golden(GetParam(), folder_ / "trajectory.txt"));
  EXPECT_EQ(stats["frames"], 60);
  EXPECT_EQ(stats["lost_frames"], 0);
  EXPECT_EQ(stats["resets"], 0);
  EXPECT_GT(stats["distance_m"], 1.0);
  EXPECT_LT(stats["ate_rmse_m"], 0.015);
  EXPECT_LT(stats["rpe_rmse_m"], 0.003);
  EXPECT_LT(stats["rpe_rmse_deg"], 0.08);
}

TEST_P(EachScene, GivesTheSameBytesOnEveryRunAndWithEveryKernel) {
  const nlohmann::json stats = replay(folder_ / "first.txt");
  const std::string first = read_text(folder_ / "first.txt");
  for (const char* kernels : {"auto", "ref", "sse41", "avx2", "neon"}) {
    SCOPED_TRACE(kernels);
    const std::string path = folder_ / kernels;
    const auto run =
        test::run_darkling({"replay", "synthetic:" + GetParam() + ",frames=60,width=200", "--width",
                            "200", "--trajectory", path, "--stats", stats_, "--kernels", kernels});
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
