// SPDX-License-Identifier: Apache-2.0
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

void expect_misused(const std::vector<std::string>& words, const std::string& part) {
  const auto run = run_darkling(words);
  EXPECT_EQ(run.status, 64) << run.out;
  EXPECT_THAT(run.err, HasSubstr(part));
  EXPECT_EQ(run.out, "");
}

// Wrong in one row, and every other is printed all the same.
void expect_wrong(int status, const std::vector<std::string>& words, const std::string& row,
                  const std::string& part) {
  const auto run = run_darkling(words);
  EXPECT_EQ(run.status, status) << run.out;
  EXPECT_THAT(run.err, HasSubstr(part));
  EXPECT_THAT(run.out, AllOf(HasSubstr("  " + row + " wrong: "), HasSubstr(part)));
  EXPECT_THAT(run.out, AllOf(HasSubstr("  configuration "), HasSubstr("  memory "),
                             HasSubstr("  recording ")));
}

// The bytes at the start of the table's rows: of buffers (they have a count), gaps and state; and
// of the total.
struct TableSums {
  long long rows = 0;
  long long total = 0;
  int row_count = 0;
};
TableSums sums_of(const std::string& table) {
  TableSums sums;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    long long bytes = 0;
    if (!(std::istringstream(line) >> bytes)) continue;
    if (line.find("total:") != std::string::npos) {
      sums.total = bytes;
    } else if (line.find("of stack at most") == std::string::npos) {
      sums.rows += bytes;
      ++sums.row_count;
    }
  }
  return sums;
}

TEST(Check, SaysWhatItFoundOfEachThingItCanCheck) {
  const auto run = run_darkling({"check"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, AllOf(HasSubstr("configuration  ok: defaults\n"),
                             HasSubstr("calibration    not checked: no SOURCE is given\n"),
                             HasSubstr("limits         ok: thumbnail 320 x 240 px, 1000 points"),
                             HasSubstr("memory         ok: "), HasSubstr(" of 8.00 MiB")));
  EXPECT_THAT(run.out, Not(HasSubstr("written by")));
}

TEST(Check, ListsBuffersThatAddUpToTheTotal) {
  const auto run = run_darkling({"check", "--memory"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("written by"), HasSubstr("read by"), HasSubstr("bit-planes"),
                             HasSubstr("of stack at most"), HasSubstr("budget of 8.00 MiB")));
  const TableSums sums = sums_of(run.out);
  EXPECT_GT(sums.row_count, 20);
  EXPECT_GT(sums.total, 1 << 20);
  EXPECT_EQ(sums.rows, sums.total);
}

TEST(Check, ListsWhatASizeTakes) {
  const auto run = run_darkling({"check", "--memory", "--size", "640x480"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("640 x 480 px"), HasSubstr("budget of 24.00 MiB")));
  const TableSums large = sums_of(run.out);
  EXPECT_EQ(large.rows, large.total);
  EXPECT_GT(large.total, sums_of(run_darkling({"check", "--memory"}).out).total);
}

TEST(Check, TakesWidthAndSettings) {
  const auto run = run_darkling({"check", "--width", "160", "--set", "points_per_level=500"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("thumbnail 160 x 120 px, 500 points a level"));
}

TEST(Check, ChecksTheCalibrationOfASource) {
  const test::TemporaryFolder folder;
  const std::string kitti = folder / "kitti";
  test::write_tiny_kitti(kitti);
  const auto run = run_darkling({"check", kitti, "--width", "96", "--memory"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("calibration    ok: " + kitti + "/calib.txt\n"),
                             HasSubstr("thumbnail 96 x ")));
  test::replace_in_file(kitti + "/calib.txt", "P1:", "Q1:");
  expect_wrong(78, {"check", kitti, "--width", "96"}, "calibration   ", "calib.txt");
}

// What a replay says it took is what the check said it would take.
TEST(Check, AgreesWithAReplay) {
  const test::TemporaryFolder folder;
  const std::string source = "synthetic:corridor,frames=12,width=160,seed=2";
  const auto replay =
      run_darkling({"replay", source, "--width", "97", "--stats", folder / "stats.json"});
  ASSERT_EQ(replay.status, 0) << replay.err;
  const auto stats = test::read_json(folder / "stats.json");
  const auto run = run_darkling({"check", source, "--width", "97", "--memory"});
  ASSERT_EQ(run.status, 0) << run.err;
  const long long arena_bytes = stats["arena_bytes"];
  const long long total = sums_of(run.out).total;
  EXPECT_GT(total, arena_bytes);
  EXPECT_LT(total, arena_bytes + (64 << 10));  // the odometry itself
}

TEST(Check, RefusesLimitsWithNameAndNumbers) {
  expect_wrong(78, {"check", "--size", "1400x1050"}, "limits        ",
               "thumbnail width 1400 px is above kMaxWidth = 1280");
  expect_wrong(78, {"check", "--size", "320x20"}, "limits        ",
               "20 px is below kMinHeight = 24");
  expect_wrong(78, {"check", "synthetic:corridor,width=1400,height=1050", "--width", "0"},
               "limits        ", "thumbnail width 1400 px is above kMaxWidth = 1280");
}

TEST(Check, RefusesABadConfigurationWithFileAndLine) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "rover.yaml", "# mine\nwidth_px: 20\n");
  expect_wrong(78, {"check", "--config", folder / "rover.yaml"}, "configuration ",
               "rover.yaml:2: key 'width_px'");
}

TEST(Check, RefusesWordsThatContradict) {
  expect_misused({"check", "--size", "640"}, "--size: found '640', WIDTHxHEIGHT is needed");
  expect_misused({"check", "--size", "640x480", "--width", "640"}, "neither a SOURCE nor");
  expect_misused({"check", "synthetic:mine", "--size", "640x480"}, "neither a SOURCE nor");
  expect_misused({"check", "--width", "0"}, "give a SOURCE");
}

TEST(Check, TeachesAnExampleInItsHelp) {
  const auto run = run_darkling({"check", "--help"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("--memory"), HasSubstr("--size"), HasSubstr("Examples:")));
}

}  // namespace
}  // namespace darkling
