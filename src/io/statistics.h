// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vo/estimate.h"

namespace darkling {

// Nearest-rank percentiles: each is a value that occurred.
struct Percentiles {
  double p50 = 0.0;
  double p90 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

// @return nothing for no samples.
[[nodiscard]] std::optional<Percentiles> percentiles(std::vector<double> samples);

// Frames in a row of which the same is to be said.
struct StateSpan {
  std::int64_t first = 0;  // as the recording numbers them
  std::int64_t frames = 0;
  TrackStatus status = TrackStatus::kUnknown;
  std::uint32_t reasons = kReasonNone;
  int resets = 0;  // so far
};

// What happened to the frames of a run. Every input frame is in exactly one of tracked, degraded,
// lost and bad.
struct Statistics {
  std::int64_t frames = 0;
  std::int64_t tracked_frames = 0;
  std::int64_t degraded_frames = 0;
  std::int64_t lost_frames = 0;  // a good pair whose motion was not measured
  std::int64_t bad_frames = 0;   // no usable pair: skipped
  std::int64_t keyframes = 0;
  std::int64_t resets = 0;
  double distance_m = 0.0;                                      // sum of the estimated steps
  std::array<std::int64_t, kRefinementCount> refinements = {};  // by what became of them
  std::vector<StateSpan> states;                                // of all frames, in their order
  std::optional<double> frame_period_ms;  // mean distance of the stamps; none where that is <= 0
  std::array<std::int64_t, kReasonCount> reasons = {};           // frames that had the reason
  std::optional<Percentiles> frame_ms;                           // of frames that were not bad
  std::array<std::optional<Percentiles>, kStageCount> stage_us;  // of frames that ran the stage
  std::optional<Percentiles> iterations;                         // of frames that were not bad
};

// Collects as the frames come. Its memory grows by some 100 bytes a frame.
class StatisticsRecorder {
 public:
  // @param wall_time  of Odometry::track() for this frame: rectification through estimate.
  void add_tracked(const Estimate& estimate, Duration wall_time);
  // A pair that could not be used: what Odometry::skip() said.
  void add_skipped(const Estimate& estimate);

  // So far.
  [[nodiscard]] const Statistics& counts() const { return counts_; }
  [[nodiscard]] Statistics summarise() const;

 private:
  void add_motion(const Estimate& estimate);
  void add_state(const Estimate& estimate);

  Statistics counts_;
  FrameTime first_stamp_;
  FrameTime last_stamp_;
  std::vector<double> frame_ms_;
  std::vector<double> iterations_;
  std::array<std::vector<double>, kStageCount> stage_us_;
};

}  // namespace darkling
