// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/framelog/frame_log.h"
#include "drivers/injection/injection.h"
#include "integration/darkling.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::HasSubstr;

class Inject : public ::testing::Test {
 protected:
  Inject() { test::write_tiny_kitti(kitti_, {.frames = 8}); }

  static std::vector<std::string> with(std::vector<std::string> words,
                                       const std::vector<std::string>& injections) {
    for (const std::string& injection : injections) {
      words.insert(words.end(), {"--inject", injection});
    }
    return words;
  }

  // The trajectory of a replay that is done.
  std::string replay(const std::string& source, const std::vector<std::string>& injections) const {
    const auto run = run_darkling(
        with({"replay", source, "--width", "96", "--trajectory", trajectory_}, injections));
    EXPECT_EQ(run.status, 0) << run.err;
    return test::read_text(trajectory_);
  }

  test::TemporaryFolder folder_;
  std::string kitti_ = folder_ / "kitti";
  std::string log_ = folder_ / "run.lcmlog";
  std::string trajectory_ = folder_ / "trajectory.txt";
};

TEST_F(Inject, ChangesATrajectoryAndRepeatsItByteForByte) {
  const std::string clean = replay(kitti_, {});
  for (const char* injection : {"electrons=20", "drop_every=3", "freeze@3:5", "blur_px=5"}) {
    const std::string injected = replay(kitti_, {injection});
    EXPECT_NE(injected, clean) << injection;
    EXPECT_EQ(injected, replay(kitti_, {injection})) << injection;
  }
}

TEST_F(Inject, ChangesNothingOutsideOfItsRange) {
  EXPECT_EQ(replay(kitti_, {"blackout@1000:", "drop=1@500:600"}), replay(kitti_, {}));
}

TEST_F(Inject, GivesTheSameInAConvertedLogAsInTheReplay) {
  const std::vector<std::string> injections = {"electrons=50", "drop=0.3,seed=4", "skew_ms=20",
                                               "blackout@5:6"};
  const auto converted = run_darkling(with({"convert", kitti_, log_}, injections));
  ASSERT_EQ(converted.status, 0) << converted.err;
  EXPECT_EQ(replay(log_, {}), replay(kitti_, injections));
  EXPECT_THAT(open_frame_log(log_)->record.source, HasSubstr("--inject electrons=50"));
}

TEST_F(Inject, TellsWhatWasInjectedAndWhatWasLost) {
  const auto run =
      run_darkling(with({"replay", kitti_, "--width", "96"}, {"drop=1@3:5", "gain=1.5"}));
  EXPECT_THAT(run.out, HasSubstr("--inject drop=1@3:5 --inject gain=1.5"));
  EXPECT_THAT(run.out, HasSubstr("2 with an absent or damaged image"));
}

TEST_F(Inject, CountsFramesAsTheRecordingDoesNotAsTheyAreSelected) {
  const auto run = run_darkling(with(
      {"replay", kitti_, "--width", "96", "--frames", "2:8", "--stride", "2"}, {"drop=1@4:5"}));
  EXPECT_THAT(run.out, HasSubstr("3: ")) << "frames 2, 4 and 6";
  EXPECT_THAT(run.out, HasSubstr("1 bad"));
}

TEST_F(Inject, IsRecordedByRecord) {
  const auto run = run_darkling(with(
      {"record", log_, "--set", "camera=synthetic:corridor,frames=12,width=96", "--frames", "6"},
      {"drop=1@2:4"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("6 frames, 2 gaps"));
  EXPECT_THAT(open_frame_log(log_)->record.source, HasSubstr("--inject drop=1@2:4"));
}

TEST_F(Inject, IsRefusedBeforeAnythingIsOpened) {
  for (const char* verb : {"replay", "convert", "record"}) {
    std::vector<std::string> words = {verb, "nowhere", "--inject", "electrns=5"};
    if (verb == std::string("convert")) words.insert(words.begin() + 2, log_);
    const auto run = run_darkling(words);
    EXPECT_EQ(run.status, 64) << verb;
    EXPECT_THAT(run.err, HasSubstr("did you mean 'electrons'?")) << verb;
  }
}

TEST_F(Inject, IsListedByTheHelp) {
  const auto help = run_darkling({"replay", "--help"});
  for (const InjectionKind& kind : injection_kinds()) {
    EXPECT_THAT(help.out, HasSubstr("\n  " + std::string(kind.name)));
  }
}

}  // namespace
}  // namespace darkling
