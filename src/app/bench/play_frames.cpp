// SPDX-License-Identifier: Apache-2.0
#include "app/bench/play_frames.h"

#include <numeric>

#include "io/statistics.h"
#include "platform/clocks.h"
#include "vo/odometry.h"

namespace darkling {

namespace {

using Microseconds = std::chrono::duration<double, std::micro>;

// As a clock that the odometry can time its stages by.
MonotonicTime read_cpu_time() {
  return MonotonicTime{read_thread_cpu_time()};
}

template <class Time>
double median_of(std::span<const Play> plays, const Time& time) {
  std::vector<double> samples;
  for (const Play& play : plays) samples.push_back(time(play));
  return percentiles(std::move(samples)).value_or(Percentiles{}).p50;
}

}  // namespace

double PlayedFrame::rest_us() const {
  const double refine_us = stage_us[static_cast<std::size_t>(Stage::kRefine)];
  return frame_us - (std::accumulate(stage_us.begin(), stage_us.end(), 0.0) - refine_us);
}

Result<Play> play_frames(const HeldFrames& held, const OdometryConfig& config,
                         const KernelTable& kernels) {
  const auto odometry = Odometry::create(config, held.rig, kernels, read_cpu_time);
  if (!odometry) return tl::unexpected(odometry.error());
  Play play;
  play.width = (*odometry)->rig().width;
  play.height = (*odometry)->rig().height;
  play.frames.reserve(held.frames.size());
  for (const StereoFrame& frame : held.frames) {
    (*odometry)->finish_refinement();
    const MonotonicTime started_at = read_cpu_time();
    const Estimate estimate = (*odometry)->track(frame);
    const Duration time = read_cpu_time() - started_at;
    PlayedFrame& played = play.frames.emplace_back();
    played.is_keyframe = estimate.is_keyframe;
    played.frame_us = Microseconds(time).count();
    for (int stage = 0; stage < kStageCount; ++stage) {
      played.stage_us[stage] = Microseconds(estimate.stage_times[stage]).count();
    }
  }
  return play;
}

std::vector<PlayedFrame> median_frames(std::span<const Play> plays) {
  std::vector<PlayedFrame> medians = plays.front().frames;
  for (std::size_t i = 0; i < medians.size(); ++i) {
    medians[i].frame_us = median_of(plays, [i](const Play& p) { return p.frames[i].frame_us; });
    for (int stage = 0; stage < kStageCount; ++stage) {
      medians[i].stage_us[stage] =
          median_of(plays, [i, stage](const Play& p) { return p.frames[i].stage_us[stage]; });
    }
  }
  return medians;
}

double mean_frame_us(std::span<const PlayedFrame> frames, bool is_keyframe) {
  double sum_us = 0.0;
  int count = 0;
  for (const PlayedFrame& frame : frames) {
    if (frame.is_keyframe != is_keyframe) continue;
    sum_us += frame.frame_us;
    ++count;
  }
  return count > 0 ? sum_us / count : 0.0;
}

}  // namespace darkling
