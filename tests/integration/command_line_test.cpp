// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;

void expect_usage_error(const std::vector<std::string>& words, const std::string& message_part) {
  const auto run = run_darkling(words);
  EXPECT_EQ(run.status, 64) << message_part;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr(message_part));
}

TEST(CommandLine, ShowsVerbsAndExitCodesInItsHelp) {
  const auto run = run_darkling({"--help"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, AllOf(HasSubstr("replay"), HasSubstr("eval"), HasSubstr("64 usage")));
}

TEST(CommandLine, TeachesSourcesAndExamplesInTheHelpOfReplay) {
  const auto run = run_darkling({"replay", "--help"});
  EXPECT_EQ(run.status, 0);
  for (const char* part : {"--config", "--set", "--width", "--trajectory", "--format", "--truth",
                           "--stats", "--pace", "--kernels", "--frames", "--stride", "KITTI",
                           "EuRoC", "synthetic:", "Examples:", "Exit codes:"}) {
    EXPECT_THAT(run.out, HasSubstr(part));
  }
}

TEST(CommandLine, PrintsItsVersion) {
  const auto run = run_darkling({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, ::testing::MatchesRegex("darkling [0-9.]+\n"));
}

TEST(CommandLine, ShowsHelpAsAnErrorWithoutAVerb) {
  expect_usage_error({}, "Usage: darkling");
}

TEST(CommandLine, NamesTheNearestVerb) {
  expect_usage_error({"replya"}, "unknown verb 'replya', did you mean 'replay'?");
}

TEST(CommandLine, NamesTheNearestOption) {
  expect_usage_error({"replay", "x", "--wdith", "310"},
                     "unknown option '--wdith', did you mean '--width'?");
  expect_usage_error({"replay", "x", "--trajectroy=a.txt"}, "did you mean '--trajectory'?");
  expect_usage_error({"--hlep"}, "did you mean '--help'?");
}

TEST(CommandLine, RefusesWordsTooManyAndTooFew) {
  expect_usage_error({"replay"}, "SOURCE is missing");
  expect_usage_error({"replay", "a", "b"}, "not expected: b");
  expect_usage_error({"eval", "a"}, "ESTIMATE is required");
  expect_usage_error({"replay", "a", "--width"}, "--width");
}

TEST(CommandLine, SaysWhatIsAllowedOfAnOption) {
  expect_usage_error({"replay", "x", "--pace", "slow"}, "allowed are fast, recorded");
  expect_usage_error({"replay", "x", "--format", "csv"}, "allowed are tum, kitti");
  expect_usage_error({"replay", "x", "--stride", "0"}, "allowed is 1 and more");
  expect_usage_error({"replay", "x", "--frames", "9:3"}, "allowed is A:B");
  expect_usage_error({"replay", "x", "--width", "12"}, "allowed is 64 to 1280 px or 0");
  expect_usage_error({"replay", "x", "--set", "widht_px=9"}, "did you mean 'width_px'?");
  expect_usage_error({"replay", "x", "--kernels", "sse5"}, "ref");
}

TEST(CommandLine, TakesOneWordForEachSetting) {
  for (const char* verb : {"replay", "check"}) {
    const auto run =
        run_darkling({verb, "--set", "width_px=177", "--set", "points_per_level=200", "/absent"});
    EXPECT_EQ(run.status, 66) << verb;
    EXPECT_THAT(run.err, HasSubstr("/absent")) << verb;
  }
  const test::TemporaryFolder folder;
  const auto render = run_darkling(
      {"render", "--set", "frames=1", "--set", "width=64", "corridor", folder / "corridor"});
  EXPECT_EQ(render.status, 0) << render.err;
}

TEST(CommandLine, PrintsTheConfigurationItWouldUse) {
  const auto run = run_darkling({"replay", "--width", "177", "--print-config"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("\nwidth_px: 177\n"));
}

}  // namespace
}  // namespace darkling
