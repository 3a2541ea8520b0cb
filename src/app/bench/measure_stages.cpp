// SPDX-License-Identifier: Apache-2.0
#include "app/bench/measure_stages.h"

#include "platform/clocks.h"
#include "vo/odometry.h"

namespace darkling {

namespace {

template <class Time>
StageTimes summarise(const std::string& name, std::span<const PlayedFrame> frames,
                     const Time& time_us) {
  std::vector<double> all;
  std::vector<double> keyframes;
  std::vector<double> others;
  for (const PlayedFrame& frame : frames) {
    const double us = time_us(frame);
    if (us <= 0.0) continue;
    all.push_back(us);
    (frame.is_keyframe ? keyframes : others).push_back(us);
  }
  return {name, percentiles(all), percentiles(keyframes), percentiles(others)};
}

std::vector<StageTimes> summarise_stages(std::span<const PlayedFrame> frames) {
  std::vector<StageTimes> stages;
  stages.reserve(kStageCount + 2);
  for (int stage = 0; stage < kStageCount; ++stage) {
    stages.push_back(summarise(kStageNames[stage], frames,
                               [stage](const PlayedFrame& f) { return f.stage_us[stage]; }));
  }
  stages.push_back(summarise("rest", frames, [](const PlayedFrame& f) { return f.rest_us(); }));
  stages.push_back(summarise("frame", frames, [](const PlayedFrame& f) { return f.frame_us; }));
  return stages;
}

double share_of(Stage stage, std::span<const PlayedFrame> frames) {
  double stage_us = 0.0;
  double frame_us = 0.0;
  for (const PlayedFrame& frame : frames) {
    stage_us += frame.stage_us[static_cast<std::size_t>(stage)];
    frame_us += frame.frame_us;
  }
  return frame_us > 0.0 ? stage_us / frame_us : 0.0;
}

void add_work(const FrameWork& work, FrameCost& cost) {
  ++cost.frames;
  for (int k = 0; k < kKernelCount; ++k) {
    cost.work[k].units += work[k].units;
    cost.work[k].total.bytes += work[k].total.bytes;
    cost.work[k].total.byte_operations += work[k].total.byte_operations;
    cost.work[k].total.float_operations += work[k].total.float_operations;
  }
}

void divide_by_frames(FrameCost& cost) {
  for (KernelWork& work : cost.work) {
    const double n = cost.frames > 0 ? cost.frames : 1.0;
    work.units /= n;
    work.total.bytes /= n;
    work.total.byte_operations /= n;
    work.total.float_operations /= n;
  }
}

Result<void> count_work(const HeldFrames& held, const StagePlan& plan, StageReport& report) {
  const auto odometry =
      Odometry::create(plan.config, held.rig, counting_kernels(plan.kernels), read_monotonic_clock);
  if (!odometry) return tl::unexpected(odometry.error());
  (void)take_counted_work();
  for (const StereoFrame& frame : held.frames) {
    const Estimate estimate = (*odometry)->track(frame);
    add_work(take_counted_work(), estimate.is_keyframe ? report.keyframes : report.others);
  }
  divide_by_frames(report.keyframes);
  divide_by_frames(report.others);
  return {};
}

void compare(const KernelReport& speed, FrameCost& cost) {
  for (const KernelTimings& kernel : speed.kernels) {
    const KernelWork& work = cost.work[static_cast<std::size_t>(kernel.kernel)];
    const PeakSpeed& peak = speed.peaks.front();
    cost.least += roofline(work.total, {kernel.copy_bytes_per_ns, peak.byte_operations_per_ns,
                                        peak.float_operations_per_ns});
    cost.kernels_us += 1e-3 * work.units * kernel.variants.front().time.median_ns;
  }
}

}  // namespace

Result<StageReport> measure_stages(const HeldFrames& held, const StagePlan& plan) {
  std::vector<Play> plays;
  for (int i = 0; i <= plan.repeats; ++i) {
    auto play = play_frames(held, plan.config, plan.kernels);
    if (!play) return tl::unexpected(play.error());
    if (i > 0) plays.push_back(std::move(*play));  // the first one warms up
    if (plan.show) plan.show(i, plan.repeats);
  }
  const std::vector<PlayedFrame> frames = median_frames(plays);
  StageReport report;
  report.source = held.source;
  report.kernels = plan.kernels.name;
  report.width = plays.front().width;
  report.height = plays.front().height;
  report.points_per_level = plan.config.points_per_level;
  report.repeats = plan.repeats;
  report.stages = summarise_stages(frames);
  report.rectify_share = share_of(Stage::kRectify, frames);
  if (auto counted = count_work(held, plan, report); !counted) {
    return tl::unexpected(counted.error());
  }
  report.keyframes.measured_us = mean_frame_us(frames, true);
  report.others.measured_us = mean_frame_us(frames, false);
  return report;
}

void compare_with_kernels(const KernelReport& speed, StageReport& report) {
  compare(speed, report.keyframes);
  compare(speed, report.others);
}

}  // namespace darkling
