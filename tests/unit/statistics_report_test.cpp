// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/run_report.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

RunReport example_report() {
  RunReport report;
  report.source = "/rec/night";
  report.statistics.frames = 10;
  report.statistics.tracked_frames = 7;
  report.statistics.degraded_frames = 1;
  report.statistics.lost_frames = 1;
  report.statistics.bad_frames = 1;
  report.statistics.keyframes = 3;
  report.statistics.frame_ms = Percentiles{.p50 = 2.0, .p90 = 3.0, .p99 = 4.0, .max = 5.0};
  report.statistics.frame_period_ms = 50.0;
  report.statistics.stage_us[0] = Percentiles{.p50 = 20.0, .p90 = 30.0, .p99 = 40.0, .max = 50.0};
  report.faults.unreadable = 1;
  report.kernels = "ref";
  report.width_px = 320;
  report.height_px = 240;
  report.arena_bytes = 3 << 20;
  report.trajectory_sha256 = "ab";
  return report;
}

Evaluation example_evaluation() {
  return {.matched_poses = 9,
          .path_m = 60.0,
          .drift_percent = 0.25,
          .drift_deg_per_m = 0.002,
          .ate_rmse_m = 0.11,
          .rpe_rmse_m = 0.012,
          .rpe_rmse_deg = 0.03,
          .nees_motion = Nees{.count = 8, .mean = 1.25},
          .nees_pose = std::nullopt,
          .confidence = Confidence{.frames = 6, .wrong = {4}}};
}

TEST(StatisticsJson, HasEveryFixedKey) {
  const Json json = Json::parse(format_statistics_json(example_report()));
  for (const char* key :
       {"frames",           "keyframes",    "lost_frames",   "resets",
        "distance_m",       "ate_rmse_m",   "drift_percent", "drift_deg_per_m",
        "rpe_rmse_m",       "rpe_rmse_deg", "nees_motion",   "nees_pose",
        "frame_ms",         "stage_us",     "arena_bytes",   "heap_calls_after_start",
        "peak_rss_bytes",   "kernels",      "width",         "height",
        "trajectory_sha256"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  for (const char* key : {"p50", "p90", "p99", "max"}) {
    EXPECT_TRUE(json["frame_ms"].contains(key)) << key;
  }
  EXPECT_EQ(json["stage_us"]["rectify"]["p50"], 20.0);
  EXPECT_EQ(json["stage_us"]["rectify"]["p99"], 40.0);
  EXPECT_FALSE(json["stage_us"].contains("track"));
}

TEST(StatisticsJson, SaysNullForWhatIsNotKnown) {
  RunReport report = example_report();
  report.statistics.frame_ms.reset();
  const Json json = Json::parse(format_statistics_json(report));
  for (const char* key : {"ate_rmse_m", "drift_percent", "rpe_rmse_m", "heap_calls_after_start",
                          "peak_rss_bytes", "frame_ms", "confident_frames", "confidently_wrong"}) {
    EXPECT_TRUE(json[key].is_null()) << key;
  }
}

TEST(StatisticsJson, CarriesTheFiguresOfTheEvaluation) {
  RunReport report = example_report();
  report.evaluation = example_evaluation();
  const Json json = Json::parse(format_statistics_json(report));
  EXPECT_EQ(json["drift_percent"], 0.25);
  EXPECT_EQ(json["drift_deg_per_m"], 0.002);
  EXPECT_EQ(json["ate_rmse_m"], 0.11);
  EXPECT_EQ(json["rpe_rmse_m"], 0.012);
  EXPECT_EQ(json["rpe_rmse_deg"], 0.03);
  EXPECT_EQ(json["nees_motion"], 1.25);
  EXPECT_TRUE(json["nees_pose"].is_null());
  EXPECT_EQ(json["confident_frames"], 6);
  EXPECT_EQ(json["confidently_wrong"], 1);
  EXPECT_EQ(json["confidently_wrong_frames"], Json({4}));
}

TEST(StatisticsJson, TellsStatesWithTheirReasons) {
  RunReport report = example_report();
  report.statistics.states = {{.first = 0, .frames = 7, .status = TrackStatus::kValid},
                              {.first = 7,
                               .frames = 2,
                               .status = TrackStatus::kLost,
                               .reasons = kReasonLowTexture | kReasonNoDepth,
                               .resets = 1}};
  const Json states = Json::parse(format_statistics_json(report))["states"];
  ASSERT_EQ(states.size(), 2u);
  EXPECT_EQ(states[0]["state"], "valid");
  EXPECT_TRUE(states[0]["reasons"].empty());
  EXPECT_EQ(states[1]["first"], 7);
  EXPECT_EQ(states[1]["frames"], 2);
  EXPECT_EQ(states[1]["state"], "lost");
  EXPECT_EQ(states[1]["reasons"], Json({"low_texture", "no_depth"}));
  EXPECT_EQ(states[1]["resets"], 1);
}

TEST(StatisticsJson, IsValidForANameThatIsNotUtf8) {
  RunReport report = example_report();
  report.source = "/rec/\xff\xfe";
  EXPECT_TRUE(Json::accept(format_statistics_json(report)));
}

TEST(Summary, CountsFramesByWhatBecameOfThem) {
  const std::string summary = format_summary(example_report());
  EXPECT_THAT(summary, HasSubstr("/rec/night\n"));
  EXPECT_THAT(summary, HasSubstr("10: 7 tracked, 1 degraded, 1 lost, 1 bad"));
  EXPECT_THAT(summary, HasSubstr("1 with an absent or damaged image"));
  EXPECT_THAT(summary, HasSubstr("3.0 MiB fixed at start\n"));
  EXPECT_THAT(summary, Not(HasSubstr("interrupted")));
}

TEST(Summary, SaysHowMuchOfRealTimeAFrameTakes) {
  EXPECT_THAT(format_summary(example_report()),
              HasSubstr("2.00 ms a frame (p50), 4.00 ms (p99): 4.0 % of real time at 20 Hz"));
}

TEST(Summary, ShowsErrorsOnlyAgainstATruth) {
  RunReport report = example_report();
  EXPECT_THAT(format_summary(report), Not(HasSubstr("drift")));
  report.evaluation = example_evaluation();
  EXPECT_THAT(format_summary(report), HasSubstr("0.25 %, 0.0020 deg/m"));
  EXPECT_THAT(format_summary(report), HasSubstr("NEES motion 1.25"));
  EXPECT_THAT(format_summary(report), HasSubstr("6 sure frames, 1 of them wrong"));
  EXPECT_THAT(format_summary(report), Not(HasSubstr("NEES pose")));
  report.evaluation->drift_percent.reset();
  EXPECT_THAT(format_summary(report), HasSubstr("shorter than 5 m"));
}

TEST(Summary, MarksAnInterruptedRun) {
  RunReport report = example_report();
  report.was_interrupted = true;
  EXPECT_THAT(format_summary(report), HasSubstr("/rec/night  (interrupted)"));
}

TEST(Summary, ShowsHeapCallsWhereTheyAreCounted) {
  RunReport report = example_report();
  report.heap_calls_after_start = 0;
  EXPECT_THAT(format_summary(report), HasSubstr("3.0 MiB fixed at start, 0 heap calls after\n"));
  report.heap_calls_after_start = 17;
  EXPECT_THAT(format_summary(report), HasSubstr(", 17 heap calls after"));
}

}  // namespace
}  // namespace darkling
