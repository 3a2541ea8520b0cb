// SPDX-License-Identifier: Apache-2.0
#include "app/replay.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <span>

#include "app/due_wishes.h"
#include "app/injected_recording.h"
#include "app/progress_line.h"
#include "app/replay_log.h"
#include "app/service/follow_pair.h"
#include "app/service/obey_wish.h"
#include "app/verb.h"
#include "io/run_report.h"
#include "platform/clocks.h"
#include "platform/cpu_features.h"
#include "platform/heap_probe.h"
#include "platform/process_memory.h"
#include "platform/signals.h"
#include "vo/odometry.h"

namespace darkling {

namespace {

constexpr Duration kFrameTimeout = std::chrono::milliseconds(200);  // how late a stop may be seen

// A run with everything that can be wrong before its first frame behind it.
struct Run {
  KernelTable kernels;
  Recording recording;
  std::unique_ptr<Odometry> odometry;
  std::optional<Trajectory> truth;
  std::string truth_name;
  RunOutputs outputs;
  std::optional<ReplayLog> log;
  StatisticsRecorder statistics;
  DueWishes wishes;                        // of the recording
  std::optional<std::int64_t> heap_calls;  // of the odometry since it was created
};

struct Truth {
  std::optional<Trajectory> trajectory;
  std::string name;
};

// The truth the user names, else the recording's own, else none.
Result<Truth> find_truth(const ReplayOptions& options, const Recording& recording) {
  const std::string path = options.truth_path.empty() ? recording.truth_path : options.truth_path;
  if (path.empty() && !recording.truth) return Truth{};
  if (path.empty()) {
    return Truth{recording.truth, recording.kind == "synthetic" ? "exact" : "the log's own"};
  }
  const auto trajectory = read_trajectory(path);
  if (!trajectory) return tl::unexpected(trajectory.error());
  return Truth{*trajectory, path};
}

// The log that is asked for, if one is: the last of all preparations, so that no empty one is left
// behind.
Result<std::optional<ReplayLog>> open_log(const ReplayOptions& options, const Config& config,
                                          const Recording& recording, const Odometry& odometry,
                                          const Truth& truth, const KernelTable& kernels) {
  if (options.log_path.empty()) return std::optional<ReplayLog>();
  const ReplayFacts facts{.source = name_injected(options.source, options.injections),
                          .kernels = kernels.name,
                          .arena_bytes = static_cast<std::int64_t>(odometry.arena_bytes()),
                          .width_px = odometry.rig().width,
                          .height_px = odometry.rig().height,
                          .period = Duration(std::llround(1e9 / config.camera.rate_hz))};
  auto log = ReplayLog::create(options.log_path, config, recording.rig, truth.trajectory, facts);
  if (!log) return tl::unexpected(log.error());
  return std::optional(std::move(*log));
}

Result<Run> prepare(const ReplayOptions& options) {
  const auto config = load_config(options.config_path, options.settings);
  if (!config) return tl::unexpected(config.error());
  const auto kernels = select_kernels(options.kernels, detect_cpu_features());
  if (!kernels) return tl::unexpected(kernels.error());
  auto recording = open_source(options.source, options.frames);
  if (!recording) return tl::unexpected(recording.error());
  recording->source = inject_into(std::move(recording->source), recording->rig, options.injections);
  auto odometry =
      Odometry::create(config->odometry, recording->rig, *kernels, read_monotonic_clock);
  if (!odometry) return tl::unexpected(odometry.error());
  auto truth = find_truth(options, *recording);
  if (!truth) return tl::unexpected(truth.error());
  const auto [frame, key] = truth->trajectory
                                ? std::pair(truth->trajectory->frame, truth->trajectory->key)
                                : std::pair(PoseFrame::kLeft, PoseKey::kRow);
  auto outputs = RunOutputs::open(options.outputs, frame, key, (*odometry)->rig().T_body_left);
  if (!outputs) return tl::unexpected(outputs.error());
  if (auto started = recording->source->start(); !started) {
    return tl::unexpected(started.error());
  }
  auto log = open_log(options, *config, *recording, **odometry, *truth, *kernels);
  if (!log) return tl::unexpected(log.error());
  DueWishes wishes(std::move(recording->wishes));
  return Run{.kernels = *kernels,
             .recording = std::move(*recording),
             .odometry = std::move(*odometry),
             .truth = std::move(truth->trajectory),
             .truth_name = std::move(truth->name),
             .outputs = std::move(*outputs),
             .log = std::move(*log),
             .statistics = {},
             .wishes = std::move(wishes),
             .heap_calls = count_heap_calls() ? std::optional<std::int64_t>(0) : std::nullopt};
}

// One input frame: tracked and timed when there is a pair, else skipped; heap calls are counted.
// The last keyframe is refined before the time of the frame begins, as between frames of a camera.
// @param wishes  what the odometry was asked for before this frame when it was recorded.
Estimate follow(Run& run, const WaitResult& next, std::span<const RecordedWish> wishes) {
  const bool is_bad = next.status == WaitStatus::kBadFrame;
  const auto heap_calls_before = count_heap_calls();
  run.odometry->finish_refinement();
  for (const RecordedWish& recorded : wishes) obey_wish(*run.odometry, recorded.wish);
  const MonotonicTime started_at = read_monotonic_clock();
  const Estimate estimate = follow_pair(*run.odometry, next);
  const Duration wall_time = read_monotonic_clock() - started_at;
  if (run.heap_calls) *run.heap_calls += *count_heap_calls() - *heap_calls_before;
  if (is_bad) {
    run.statistics.add_skipped(estimate);
  } else {
    run.statistics.add_tracked(estimate, wall_time);
  }
  return estimate;
}

tl::unexpected<Error> swapped_eyes(const Recording& recording) {
  return failure(ExitCode::kBadInput,
                 recording.name +
                     ": left and right are swapped: the images agree far better the other way "
                     "round. Exchange the two image folders (or the two cameras).");
}

Result<void> play(Run& run, Pace pace) {
  Pacer pacer(pace);
  ProgressLine progress(run.recording.frame_count);
  while (!is_stop_requested()) {
    const WaitResult next = run.recording.source->wait_next(kFrameTimeout);
    if (next.status == WaitStatus::kEndOfSource) break;
    if (next.status == WaitStatus::kTimeout) continue;
    if (next.status == WaitStatus::kDeviceLost) {
      return failure(ExitCode::kNoInput, run.recording.name + ": cannot be read any further");
    }
    const bool is_bad = next.status == WaitStatus::kBadFrame;
    pacer.wait_for(is_bad ? next.stamp : next.lease.frame().stamp);
    const auto wishes = run.wishes.take(is_bad ? next.sequence : next.lease.frame().sequence);
    const Estimate estimate = follow(run, next, wishes);
    run.outputs.append(estimate);
    if (run.log) {
      if (auto logged = run.log->add(next, wishes, estimate); !logged) return logged;
    }
    progress.show(run.statistics.counts().frames, estimate.status);
    if ((estimate.reasons & kReasonEyesSwapped) != 0) return swapped_eyes(run.recording);
  }
  return {};
}

// Without figures for runs too short to compare; those tell nothing about the truth.
Result<std::optional<Evaluation>> evaluate_run(const Run& run, const TruthNoise& truth_noise) {
  constexpr std::size_t kFewestPoses = 3;
  if (!run.truth || run.outputs.trajectory().poses.size() < kFewestPoses) return std::nullopt;
  auto evaluation =
      evaluate(*run.truth, run.outputs.trajectory(), run.outputs.uncertainties(), truth_noise);
  if (evaluation) return *evaluation;
  return failure(evaluation.error().code, run.truth_name + ": " + evaluation.error().message);
}

std::vector<std::string> describe_outputs(const Run& run) {
  std::vector<std::string> rows = run.outputs.describe();
  if (run.log) rows.push_back("frame log   " + run.log->path() + " (with what is published)");
  return rows;
}

RunReport report_run(Run& run, const ReplayOptions& options) {
  const SourceStats source = run.recording.source->stats();
  const RectifiedRig& rig = run.odometry->rig();
  return {.source = name_injected(options.source, options.injections),
          .was_interrupted = is_stop_requested(),
          .statistics = run.statistics.summarise(),
          .faults = {.unreadable = source.unreadable,
                     .wrong_size = source.wrong_size,
                     .unpaired = source.unpaired,
                     .stamps_not_increasing = source.stamps_not_increasing},
          .truth = run.truth_name,
          .evaluation = std::nullopt,
          .kernels = run.kernels.name,
          .width_px = rig.width,
          .height_px = rig.height,
          .arena_bytes = static_cast<std::int64_t>(run.odometry->arena_bytes()),
          .heap_calls_after_start = run.heap_calls,
          .peak_rss_bytes = read_peak_rss_bytes(),
          .trajectory_sha256 = run.outputs.finish_sha256(),
          .outputs = describe_outputs(run)};
}

}  // namespace

Result<int> replay(const ReplayOptions& options) {
  auto run = prepare(options);
  if (!run) return tl::unexpected(run.error());
  if (!run->recording.damage.empty()) {
    std::fprintf(stderr, "darkling: %s\n", run->recording.damage.c_str());
  }
  catch_stop_signals();
  const auto played = play(*run, options.pace);

  // Whatever went wrong on the way, what there is gets written and told first.
  RunReport report = report_run(*run, options);
  const auto evaluation = evaluate_run(*run, options.truth_noise);
  if (evaluation) report.evaluation = *evaluation;
  const auto closed = run->outputs.close();
  const auto log_closed = run->log ? run->log->close() : Result<void>();
  const auto stats_written = run->outputs.write_stats(format_statistics_json(report));
  std::fputs(format_summary(report).c_str(), stdout);

  if (!played) return tl::unexpected(played.error());
  if (!closed) return tl::unexpected(closed.error());
  if (!log_closed) return tl::unexpected(log_closed.error());
  if (!stats_written) return tl::unexpected(stats_written.error());
  if (report.was_interrupted) return kInterruptedStatus;
  if (!evaluation) return tl::unexpected(evaluation.error());
  return 0;
}

}  // namespace darkling
