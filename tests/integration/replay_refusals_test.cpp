// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ReplayRefuses : public ::testing::Test {
 protected:
  ReplayRefuses() { test::write_tiny_kitti(kitti_); }

  void expect(int status, const std::string& message_part,
              const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words = {"replay", kitti_, "--width", "96"};
    words.insert(words.end(), options.begin(), options.end());
    const auto run = run_darkling(words);
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_THAT(run.err, HasSubstr(message_part));
  }

  test::TemporaryFolder folder_;
  std::string kitti_ = folder_ / "kitti";
};

TEST_F(ReplayRefuses, AnAbsentFolder) {
  const auto run = run_darkling({"replay", folder_ / "absent"});
  EXPECT_EQ(run.status, 66);
  EXPECT_THAT(run.err, HasSubstr("absent"));
}

TEST_F(ReplayRefuses, AnAbsentCalibration) {
  test::remove_path(kitti_ + "/calib.txt");
  expect(78, "calib.txt");
}

TEST_F(ReplayRefuses, AMalformedCalibration) {
  test::replace_in_file(kitti_ + "/calib.txt", "P1:", "Q1:");
  expect(78, "calib.txt");
}

TEST_F(ReplayRefuses, OutputsThatCannotBeWrittenBeforeTheRun) {
  const std::string absent = folder_ / "absent/a.txt";
  expect(64, "absent/a.txt: cannot be opened for writing", {"--trajectory", absent});
  expect(64, "absent/a.txt: cannot be opened for writing", {"--stats", absent});
  const auto run = run_darkling({"replay", kitti_, "--width", "96", "--stats", absent});
  EXPECT_EQ(run.out, "");  // no table: nothing was run
}

TEST_F(ReplayRefuses, OneFileForTwoOutputs) {
  const std::string both = folder_ / "both";
  expect(64, "named by both", {"--trajectory", both, "--stats", both});
}

TEST_F(ReplayRefuses, ABadSourceWithoutTouchingTheOutputs) {
  const std::string kept = folder_ / "kept.txt";
  test::write_text(kept, "of an earlier run");
  test::remove_path(kitti_ + "/calib.txt");
  expect(78, "calib.txt", {"--trajectory", kept});
  EXPECT_EQ(test::read_text(kept), "of an earlier run");
}

TEST_F(ReplayRefuses, SwappedEyesByName) {
  const std::filesystem::path kitti(kitti_);
  std::filesystem::rename(kitti / "image_0", kitti / "aside");
  std::filesystem::rename(kitti / "image_1", kitti / "image_0");
  std::filesystem::rename(kitti / "aside", kitti / "image_1");
  expect(65, "left and right are swapped");
}

TEST_F(ReplayRefuses, AnAbsentOrMalformedTruth) {
  expect(66, "absent.txt", {"--truth", folder_ / "absent.txt"});
  const std::string malformed = folder_ / "malformed.txt";
  test::write_text(malformed, "1 2 3\n");
  expect(65, "malformed.txt:1: 3 columns", {"--truth", malformed});
}

TEST_F(ReplayRefuses, ATruthOfAnotherTimeAfterWritingWhatItHas) {
  const std::string truth = folder_ / "truth.tum";
  const std::string trajectory = folder_ / "trajectory.txt";
  test::write_text(truth, "900.0 0 0 0 0 0 0 1\n900.1 0 0 0 0 0 0 1\n900.2 0 0 0 0 0 0 1\n");
  expect(65, "the truth covers 900.000000000 s to 900.200000000 s, the estimate 0.000000000 s to",
         {"--truth", truth, "--trajectory", trajectory});
  EXPECT_EQ(test::count_lines(test::read_text(trajectory)), 4u);
}

TEST_F(ReplayRefuses, AWrongConfigurationFileByFileAndLine) {
  const std::string config = folder_ / "rover.yaml";
  test::write_text(config, "points_per_level: 700\nwidht_px: 96\n");
  expect(78, "rover.yaml:2: unknown key 'widht_px', did you mean 'width_px'?",
         {"--config", config});
  expect(66, "absent.yaml", {"--config", folder_ / "absent.yaml"});
}

TEST_F(ReplayRefuses, ToCallAFullDiskDone) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  expect(64, "/dev/full: is incomplete: No space left", {"--trajectory", "/dev/full"});
  expect(64, "/dev/full: is incomplete: No space left", {"--stats", "/dev/full"});
}

}  // namespace
}  // namespace darkling
