// SPDX-License-Identifier: Apache-2.0
#include "io/statistics.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace darkling {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;
using Microseconds = std::chrono::duration<double, std::micro>;

// @pre `sorted` is sorted and not empty.
double nearest_rank(const std::vector<double>& sorted, double percent) {
  const auto count = static_cast<double>(sorted.size());
  const auto rank = static_cast<std::size_t>(std::ceil(percent / 100.0 * count));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

std::optional<Percentiles> percentiles(std::vector<double> samples) {
  if (samples.empty()) return std::nullopt;
  std::sort(samples.begin(), samples.end());
  return Percentiles{.p50 = nearest_rank(samples, 50.0),
                     .p90 = nearest_rank(samples, 90.0),
                     .p99 = nearest_rank(samples, 99.0),
                     .max = samples.back()};
}

void StatisticsRecorder::add_motion(const Estimate& estimate) {
  if (counts_.frames == 0) first_stamp_ = estimate.stamp;
  last_stamp_ = estimate.stamp;
  ++counts_.frames;
  counts_.resets = estimate.reset_counter;
  add_state(estimate);
  counts_.distance_m += estimate.T_previous_body.translation().norm();
  for (int bit = 0; bit < kReasonCount; ++bit) {
    if ((estimate.reasons >> bit & 1u) != 0) ++counts_.reasons[bit];
  }
  if (estimate.refinement != Refinement::kUnknown) {
    ++counts_.refinements[static_cast<std::size_t>(estimate.refinement)];
  }
}

void StatisticsRecorder::add_state(const Estimate& estimate) {
  std::vector<StateSpan>& spans = counts_.states;
  const bool goes_on = !spans.empty() && spans.back().status == estimate.status &&
                       spans.back().reasons == estimate.reasons &&
                       spans.back().resets == estimate.reset_counter;
  if (!goes_on) {
    spans.push_back({.first = estimate.sequence,
                     .frames = 0,
                     .status = estimate.status,
                     .reasons = estimate.reasons,
                     .resets = estimate.reset_counter});
  }
  ++spans.back().frames;
}

void StatisticsRecorder::add_tracked(const Estimate& estimate, Duration wall_time) {
  add_motion(estimate);
  switch (estimate.status) {
    case TrackStatus::kValid:
      ++counts_.tracked_frames;
      break;
    case TrackStatus::kDegraded:
      ++counts_.degraded_frames;
      break;
    case TrackStatus::kUnknown:
    case TrackStatus::kLost:
      ++counts_.lost_frames;
      break;
  }
  if (estimate.is_keyframe) ++counts_.keyframes;
  frame_ms_.push_back(Milliseconds(wall_time).count());
  iterations_.push_back(estimate.iterations);
  for (int stage = 0; stage < kStageCount; ++stage) {
    const Duration time = estimate.stage_times[stage];
    if (time > Duration::zero()) stage_us_[stage].push_back(Microseconds(time).count());
  }
}

void StatisticsRecorder::add_skipped(const Estimate& estimate) {
  add_motion(estimate);
  ++counts_.bad_frames;
}

Statistics StatisticsRecorder::summarise() const {
  Statistics statistics = counts_;
  if (counts_.frames > 1 && last_stamp_ > first_stamp_) {
    statistics.frame_period_ms =
        Milliseconds(last_stamp_ - first_stamp_).count() / static_cast<double>(counts_.frames - 1);
  }
  statistics.frame_ms = percentiles(frame_ms_);
  statistics.iterations = percentiles(iterations_);
  for (int stage = 0; stage < kStageCount; ++stage) {
    statistics.stage_us[stage] = percentiles(stage_us_[stage]);
  }
  return statistics;
}

}  // namespace darkling
