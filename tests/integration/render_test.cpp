// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::HasSubstr;

class Render : public ::testing::Test {
 protected:
  test::ProgramResult render(const std::string& scene, const std::string& folder,
                             const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words = {"render", scene, folder, "--frames", "4", "--width", "96"};
    words.insert(words.end(), options.begin(), options.end());
    return run_darkling(words);
  }

  test::TemporaryFolder folder_;
  std::string recording_ = folder_ / "recording";
  std::string stats_ = folder_ / "stats.json";
};

TEST_F(Render, WritesInEitherLayoutWhatReplayPlaysWithTruth) {
  for (const char* layout : {"euroc", "kitti"}) {
    const std::string recording = folder_ / layout;
    const auto rendered = render("corridor", recording, {"--layout", layout});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    const auto run = run_darkling({"replay", recording, "--width", "96", "--stats", stats_});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(test::read_json(stats_)["frames"], 4) << layout;
    EXPECT_EQ(test::read_json(stats_)["truth_poses"], 4) << layout;
  }
}

TEST_F(Render, WritesWhatTheSourceOfTheSameNamePlays) {
  ASSERT_EQ(render("mine", recording_, {"--seed", "3"}).status, 0);
  ASSERT_EQ(run_darkling({"replay", recording_, "--width", "96", "--stats", stats_}).status, 0);
  const auto from_disk = test::read_json(stats_);
  ASSERT_EQ(run_darkling({"replay", "synthetic:mine,frames=4,width=96,seed=3", "--width", "96",
                          "--stats", stats_})
                .status,
            0);
  const auto on_the_fly = test::read_json(stats_);
  EXPECT_EQ(from_disk["frames"], on_the_fly["frames"]);
  // The calibration went through a text file: close, not equal.
  EXPECT_NEAR(from_disk["distance_m"].get<double>(), on_the_fly["distance_m"].get<double>(), 1e-4);
}

TEST_F(Render, TakesKeysBehindTheSceneAndWithSet) {
  const auto run = render("corridor,electrons=30", recording_, {"--set", "gain=2"});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto wrong = render("corridor", folder_ / "b", {"--set", "gian=2"});
  EXPECT_EQ(wrong.status, 64);
  EXPECT_THAT(wrong.err, HasSubstr("gian"));
}

TEST_F(Render, RefusesAFolderThatHoldsSomething) {
  test::write_text(recording_ + "/thesis.txt", "all of it");
  EXPECT_EQ(render("corridor", recording_).status, 64);
  EXPECT_EQ(test::read_text(recording_ + "/thesis.txt"), "all of it");
}

TEST_F(Render, RefusesAnUnknownSceneAndLayout) {
  const auto scene = render("moon", recording_);
  EXPECT_EQ(scene.status, 64);
  EXPECT_THAT(scene.err, HasSubstr("mine, quarry, corridor"));
  const auto layout = render("mine", recording_, {"--layout", "tum"});
  EXPECT_EQ(layout.status, 64);
  EXPECT_THAT(layout.err, HasSubstr("allowed are euroc, kitti"));
}

}  // namespace
}  // namespace darkling
