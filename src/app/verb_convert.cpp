// SPDX-License-Identifier: Apache-2.0
#include "app/verb_convert.h"

#include <cstdio>
#include <filesystem>

#include "app/dataset_writer.h"
#include "app/due_wishes.h"
#include "app/injected_recording.h"
#include "app/known_poses.h"
#include "app/progress_line.h"
#include "app/truth_record.h"
#include "app/verb.h"
#include "drivers/framelog/frame_log_writer.h"
#include "drivers/framelog/rig_record.h"
#include "platform/signals.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

// Where the frames go: a log or a dataset.
class Output {
 public:
  virtual ~Output() = default;
  // What the odometry obeyed before the next pair, which is of `stamp`.
  virtual Result<void> obey(std::span<const RecordedWish> wishes, FrameTime stamp) = 0;
  virtual Result<void> add(const StereoFrame& frame) = 0;
  virtual Result<void> skip(const WaitResult& bad) = 0;
  virtual Result<void> close() = 0;
};

class LogOutput final : public Output {
 public:
  explicit LogOutput(FrameLogWriter writer) : writer_(std::move(writer)) {}
  Result<void> obey(std::span<const RecordedWish> wishes, FrameTime stamp) override {
    return add_wishes(writer_, wishes, stamp);
  }
  Result<void> add(const StereoFrame& frame) override { return writer_.add_frame(frame); }
  Result<void> skip(const WaitResult& bad) override {
    return writer_.add_gap(bad.sequence, bad.stamp, bad.fault);
  }
  Result<void> close() override { return writer_.close(); }

 private:
  FrameLogWriter writer_;
};

class DatasetOutput final : public Output {
 public:
  DatasetOutput(std::unique_ptr<DatasetWriter> writer, KnownPoses poses)
      : writer_(std::move(writer)), poses_(std::move(poses)) {}
  Result<void> obey(std::span<const RecordedWish> /*wishes*/, FrameTime) override {
    return {};  // a folder has no place for them
  }
  Result<void> add(const StereoFrame& frame) override {
    return writer_->add(frame, poses_.find(frame.sequence, frame.stamp));
  }
  Result<void> skip(const WaitResult& bad) override {
    return writer_->skip(bad.stamp, poses_.find(bad.sequence, bad.stamp));
  }
  Result<void> close() override { return writer_->close(); }

 private:
  std::unique_ptr<DatasetWriter> writer_;
  KnownPoses poses_;
};

Result<std::unique_ptr<Output>> open_log(const ConvertOptions& options, const Recording& recording,
                                         const std::optional<Trajectory>& truth) {
  std::error_code error;
  if (fs::exists(options.output, error)) {
    if (fs::equivalent(options.source, options.output, error)) {
      return failure(ExitCode::kUsage, options.output + ": is the source itself");
    }
    if (!options.is_forced) {
      return failure(ExitCode::kUsage, options.output +
                                           ": exists; name a new file, or add --force to write "
                                           "over it");
    }
  }
  rig_t rig = to_rig_record(recording.rig);
  rig.source = name_injected(options.source, options.injections);
  rig.version = DARKLING_VERSION;
  auto writer = FrameLogWriter::create(options.output, rig);
  if (!writer) return tl::unexpected(writer.error());
  if (truth) {
    if (auto added = writer->add_truth(to_truth_record(*truth)); !added) {
      return tl::unexpected(added.error());
    }
  }
  return std::make_unique<LogOutput>(std::move(*writer));
}

Result<std::unique_ptr<Output>> open_dataset(const ConvertOptions& options,
                                             const Recording& recording,
                                             const std::optional<Trajectory>& truth) {
  const bool is_kitti = *options.layout == DatasetLayout::kKitti;
  if (is_kitti && !is_rectified(recording.rig)) {
    return failure(ExitCode::kUsage,
                   options.source +
                       ": its cameras are distorted or turned against each other, and the KITTI "
                       "layout holds rectified images only; use --format euroc");
  }
  if (auto ok = prepare_folder(options.output, options.is_forced); !ok) {
    return tl::unexpected(ok.error());
  }
  const DatasetDescription description{.folder = options.output,
                                       .about = "Converted from " + recording.name,
                                       .rig = recording.rig,
                                       .rate_hz = 0.0};
  auto writer = is_kitti ? create_kitti_writer(description) : create_euroc_writer(description);
  if (!writer) return tl::unexpected(writer.error());
  return std::make_unique<DatasetOutput>(std::move(*writer), KnownPoses(truth, recording.rig));
}

// The recording's own truth, or none.
Result<std::optional<Trajectory>> read_truth(const Recording& recording) {
  if (recording.truth_path.empty()) return recording.truth;
  auto truth = read_trajectory(recording.truth_path);
  if (!truth) return tl::unexpected(truth.error());
  return std::optional<Trajectory>(std::move(*truth));
}

struct Converted {
  std::int64_t frames = 0;
  std::int64_t gaps = 0;
  std::int64_t wishes = 0;
};

// One pair, or what is known of a missing one.
Result<void> write_pair(const WaitResult& pair, DueWishes& wishes, Output& output,
                        Converted& done) {
  const bool is_frame = pair.status == WaitStatus::kFrame;
  const FrameTime stamp = is_frame ? pair.lease.frame().stamp : pair.stamp;
  const auto due = wishes.take(is_frame ? pair.lease.frame().sequence : pair.sequence);
  if (auto obeyed = output.obey(due, stamp); !obeyed) return obeyed;
  auto written = is_frame ? output.add(pair.lease.frame()) : output.skip(pair);
  if (!written) return written;
  ++(is_frame ? done.frames : done.gaps);
  done.wishes += std::ssize(due);
  return {};
}

Result<Converted> write_frames(Recording& recording, Output& output) {
  constexpr Duration kTimeout = std::chrono::milliseconds(200);  // how late a stop may be seen
  ProgressLine progress(recording.frame_count);
  DueWishes wishes(std::move(recording.wishes));
  Converted done;
  while (!is_stop_requested()) {
    const WaitResult next = recording.source->wait_next(kTimeout);
    if (next.status == WaitStatus::kEndOfSource) break;
    if (next.status == WaitStatus::kDeviceLost) {
      return failure(ExitCode::kNoInput, recording.name + ": cannot be read any further");
    }
    if (next.status != WaitStatus::kFrame && next.status != WaitStatus::kBadFrame) continue;
    if (auto written = write_pair(next, wishes, output, done); !written) {
      return tl::unexpected(written.error());
    }
    progress.show(done.frames + done.gaps);
  }
  return done;
}

void print_summary(const ConvertOptions& options, const Recording& recording,
                   const Converted& done) {
  std::printf("%lld frames of %s (%s)", static_cast<long long>(done.frames), recording.name.c_str(),
              recording.kind.c_str());
  if (done.gaps > 0) std::printf(", %lld bad ones left out", static_cast<long long>(done.gaps));
  if (done.wishes > 0) {
    std::printf(", %lld commands and hints%s", static_cast<long long>(done.wishes),
                options.layout ? " left out, which a folder cannot hold" : "");
  }
  std::printf(": %s\nTry: darkling replay %s\n", options.output.c_str(), options.output.c_str());
}

}  // namespace

Result<int> run_convert(const ConvertOptions& options) {
  auto recording = open_source(options.source, options.frames);
  if (!recording) return tl::unexpected(recording.error());
  recording->source = inject_into(std::move(recording->source), recording->rig, options.injections);
  if (!recording->damage.empty()) {
    std::fprintf(stderr, "darkling: %s\n", recording->damage.c_str());
  }
  const auto truth = read_truth(*recording);
  if (!truth) return tl::unexpected(truth.error());
  auto output = options.layout ? open_dataset(options, *recording, *truth)
                               : open_log(options, *recording, *truth);
  if (!output) return tl::unexpected(output.error());

  catch_stop_signals();
  if (auto started = recording->source->start(); !started) {
    return tl::unexpected(started.error());
  }
  const auto done = write_frames(*recording, **output);
  const auto closed = (*output)->close();
  if (!done) return tl::unexpected(done.error());
  if (!closed) return tl::unexpected(closed.error());
  print_summary(options, *recording, *done);
  return is_stop_requested() ? kInterruptedStatus : 0;
}

}  // namespace darkling
