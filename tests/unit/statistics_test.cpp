// SPDX-License-Identifier: Apache-2.0
#include "io/statistics.h"

#include <numeric>

#include <gtest/gtest.h>

namespace darkling {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

Estimate estimate_of(TrackStatus status) {
  Estimate estimate;
  estimate.status = status;
  return estimate;
}

TEST(Percentiles, AreValuesThatOccurred) {
  std::vector<double> samples(100);
  std::iota(samples.rbegin(), samples.rend(), 1.0);  // 100 … 1
  const auto p = percentiles(samples);
  ASSERT_TRUE(p);
  EXPECT_EQ(p->p50, 50.0);
  EXPECT_EQ(p->p90, 90.0);
  EXPECT_EQ(p->p99, 99.0);
  EXPECT_EQ(p->max, 100.0);
}

TEST(Percentiles, OfOneSampleAreTheSample) {
  const auto p = percentiles({3.0});
  ASSERT_TRUE(p);
  EXPECT_EQ(p->p50, 3.0);
  EXPECT_EQ(p->p99, 3.0);
  EXPECT_EQ(p->max, 3.0);
}

TEST(Percentiles, OfNothingAreNothing) {
  EXPECT_FALSE(percentiles({}));
}

TEST(StatisticsRecorder, CountsEveryFrameInOneClass) {
  StatisticsRecorder recorder;
  recorder.add_tracked(estimate_of(TrackStatus::kValid), milliseconds(1));
  recorder.add_tracked(estimate_of(TrackStatus::kValid), milliseconds(1));
  recorder.add_tracked(estimate_of(TrackStatus::kDegraded), milliseconds(1));
  recorder.add_tracked(estimate_of(TrackStatus::kLost), milliseconds(1));
  recorder.add_skipped(estimate_of(TrackStatus::kLost));
  const Statistics s = recorder.summarise();
  EXPECT_EQ(s.frames, 5);
  EXPECT_EQ(s.tracked_frames, 2);
  EXPECT_EQ(s.degraded_frames, 1);
  EXPECT_EQ(s.lost_frames, 1);
  EXPECT_EQ(s.bad_frames, 1);
}

TEST(StatisticsRecorder, JoinsFramesInARowOfWhichTheSameIsToBeSaid) {
  StatisticsRecorder recorder;
  Estimate estimate = estimate_of(TrackStatus::kValid);
  for (estimate.sequence = 30; estimate.sequence < 34; ++estimate.sequence) {
    if (estimate.sequence == 32) estimate.status = TrackStatus::kLost;
    if (estimate.sequence == 33) estimate.reasons = kReasonDropped;
    recorder.add_tracked(estimate, milliseconds(1));
  }
  estimate.reset_counter = 1;
  recorder.add_skipped(estimate);
  const std::vector<StateSpan> states = recorder.summarise().states;
  ASSERT_EQ(states.size(), 4u);
  EXPECT_EQ(states[0].first, 30);
  EXPECT_EQ(states[0].frames, 2);
  EXPECT_EQ(states[1].status, TrackStatus::kLost);
  EXPECT_EQ(states[2].reasons, kReasonDropped);
  EXPECT_EQ(states[3].first, 34);
  EXPECT_EQ(states[3].resets, 1);
}

TEST(StatisticsRecorder, AddsUpStepsKeyframesAndReasons) {
  StatisticsRecorder recorder;
  for (int i = 0; i < 4; ++i) {
    Estimate estimate = estimate_of(TrackStatus::kValid);
    estimate.T_previous_body = Se3(Eigen::Quaterniond::Identity(), {0.3, 0.4, 0.0});
    estimate.is_keyframe = i == 0;
    estimate.reset_counter = i / 2;
    estimate.reasons = i == 3 ? kReasonLowOverlap | kReasonNoDepth : kReasonNone;
    recorder.add_tracked(estimate, milliseconds(1));
  }
  const Statistics s = recorder.summarise();
  EXPECT_NEAR(s.distance_m, 2.0, 1e-12);
  EXPECT_EQ(s.keyframes, 1);
  EXPECT_EQ(s.resets, 1);
  EXPECT_EQ(s.reasons, (std::array<std::int64_t, kReasonCount>{0, 1, 0, 0, 0, 0, 1, 0}));
}

TEST(StatisticsRecorder, TimesFramesThatWereTrackedOnly) {
  StatisticsRecorder recorder;
  recorder.add_tracked(estimate_of(TrackStatus::kValid), milliseconds(2));
  recorder.add_skipped(estimate_of(TrackStatus::kLost));
  recorder.add_tracked(estimate_of(TrackStatus::kValid), milliseconds(4));
  const Statistics s = recorder.summarise();
  ASSERT_TRUE(s.frame_ms);
  EXPECT_EQ(s.frame_ms->p50, 2.0);
  EXPECT_EQ(s.frame_ms->max, 4.0);
}

TEST(StatisticsRecorder, TimesAStageOverTheFramesThatRanIt) {
  StatisticsRecorder recorder;
  for (int i = 0; i < 10; ++i) {
    Estimate estimate = estimate_of(TrackStatus::kValid);
    estimate.stage_times[static_cast<int>(Stage::kTrack)] = microseconds(100);
    if (i == 0) estimate.stage_times[static_cast<int>(Stage::kStereo)] = microseconds(900);
    recorder.add_tracked(estimate, milliseconds(1));
  }
  const Statistics s = recorder.summarise();
  EXPECT_EQ(s.stage_us[static_cast<int>(Stage::kStereo)].value().p50, 900.0);
  EXPECT_EQ(s.stage_us[static_cast<int>(Stage::kTrack)].value().p50, 100.0);
  EXPECT_FALSE(s.stage_us[static_cast<int>(Stage::kSelect)]);
}

TEST(StatisticsRecorder, FindsThePeriodOfTheSource) {
  StatisticsRecorder recorder;
  for (const int at_ms : {1000, 1049, 1100}) {
    Estimate estimate = estimate_of(TrackStatus::kValid);
    estimate.stamp = FrameTime(milliseconds(at_ms));
    recorder.add_tracked(estimate, milliseconds(1));
  }
  EXPECT_EQ(recorder.summarise().frame_period_ms, 50.0);
}

TEST(StatisticsRecorder, FindsNoPeriodInStampsThatStandStill) {
  StatisticsRecorder recorder;
  recorder.add_tracked(estimate_of(TrackStatus::kValid), milliseconds(1));
  EXPECT_FALSE(recorder.summarise().frame_period_ms);
  recorder.add_tracked(estimate_of(TrackStatus::kValid), milliseconds(1));
  EXPECT_FALSE(recorder.summarise().frame_period_ms);
}

}  // namespace
}  // namespace darkling
