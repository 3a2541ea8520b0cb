// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kShort = "synthetic:corridor,frames=4,width=96";

nlohmann::json run_for_json(std::vector<std::string> words) {
  words.insert(words.begin(), {"bench", "--json", "--repeat", "1"});
  const auto run = run_darkling(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out);
}

TEST(Bench, MeasuresKernelsAgainstTheReferenceAndTheMachine) {
  const auto run = run_darkling({"bench", "--size", "64x48", "--points", "100", "--repeat", "1",
                                 "--source", kShort, "--width", "64"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("This machine"), HasSubstr("at 64x48 px"), HasSubstr("bit_planes"),
                    HasSubstr("nearer to"), HasSubstr("rectify"), HasSubstr("keyframes")));
}

TEST(Bench, GivesTheSameAsJson) {
  const auto json = run_for_json({"--size", "64x48", "--kernels", "ref"});
  EXPECT_EQ(json["kernels"]["width"], 64);
  EXPECT_EQ(json["kernels"]["height"], 48);
  ASSERT_EQ(json["kernels"]["kernels"].size(), 11u);
  for (const auto& kernel : json["kernels"]["kernels"]) {
    ASSERT_EQ(kernel["variants"].size(), 1u);
    const auto& ref = kernel["variants"][0];
    EXPECT_EQ(ref["kernels"], "ref");
    EXPECT_EQ(ref["gain_over_ref"], 1.0);
    EXPECT_GT(ref["ns_per_unit"].get<double>(), 0.0);
    EXPECT_GT(ref["ratio"].get<double>(), 0.0);
  }
  EXPECT_FALSE(json.contains("stages"));
  EXPECT_FALSE(json.contains("sweep"));
}

TEST(Bench, PlaysASourceAloneAndCountsItsWork) {
  const auto json = run_for_json({"--source", kShort, "--width", "64", "--points", "100"});
  EXPECT_FALSE(json.contains("kernels"));
  const auto& stages = json["stages"];
  EXPECT_EQ(stages["width"], 64);
  EXPECT_EQ(stages["keyframes"]["frames"].get<int>() + stages["others"]["frames"].get<int>(), 4);
  EXPECT_GT(stages["stage_us"]["frame"]["all"]["p50"].get<double>(), 0.0);
  EXPECT_TRUE(stages["stage_us"]["stereo"]["others"].is_null());
  // One eye of every frame, both of a keyframe.
  EXPECT_EQ(stages["others"]["units"]["remap_area"], 64 * 48);
  EXPECT_EQ(stages["keyframes"]["units"]["remap_area"], 2 * 64 * 48);
  const double share = stages["rectify_share"].get<double>();
  EXPECT_TRUE(share > 0.0 && share < 1.0) << share;
}

TEST(Bench, SweepsWidthsAsFarAsTheSourceGoes) {
  const auto json = run_for_json(
      {"--sweep", "--source", "synthetic:corridor,frames=3,width=128", "--width", "96"});
  const auto& sweep = json["sweep"];
  EXPECT_EQ(sweep["by_width"]["settings"].size(), 2u);
  EXPECT_EQ(sweep["by_width"]["settings"][1]["width"], 128);
  EXPECT_EQ(sweep["by_points"]["settings"].size(), 5u);
  EXPECT_EQ(sweep["by_points"]["settings"][0]["width"], 96);
  EXPECT_TRUE(sweep["by_width"]["other_exponent"].is_number());
}

TEST(Bench, RefusesWhatMakesNoSense) {
  const auto expect = [](int status, const std::string& message_part,
                         std::vector<std::string> words) {
    words.insert(words.begin(), "bench");
    const auto run = run_darkling(words);
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_THAT(run.err, HasSubstr(message_part));
    EXPECT_EQ(run.out, "");
  };
  expect(64, "--size: found '320', allowed is WxH", {"--size", "320"});
  expect(64, "--size: found '320x24', allowed is WxH", {"--size", "320x24"});
  expect(64, "a sweep takes --width", {"--size", "64x48", "--sweep"});
  expect(64, "points_per_level", {"--points", "3"});
  expect(64, "--repeat: found -1", {"--repeat", "-1"});
  expect(64, "use one of: auto, ref", {"--kernels", "mmx"});
  expect(66, "absent", {"--source", "absent"});
}

}  // namespace
}  // namespace darkling
