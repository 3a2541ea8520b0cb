// SPDX-License-Identifier: Apache-2.0
#include "app/record.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <spdlog/fmt/fmt.h>

#include "app/injected_recording.h"
#include "app/service/open_camera.h"
#include "app/verb.h"
#include "drivers/framelog/frame_log_writer.h"
#include "drivers/framelog/rig_record.h"
#include "platform/clocks.h"
#include "platform/signals.h"
#include "platform/terminal.h"

namespace darkling {

namespace {

constexpr Duration kWait = std::chrono::milliseconds(100);  // how late a stop may be seen
constexpr Duration kPatience = std::chrono::seconds(10);    // a USB camera may take seconds
constexpr Duration kProgressPeriod = std::chrono::milliseconds(200);
constexpr const char* kEraseLine = "\r\033[K";
constexpr double kBytesPerMb = 1e6;

struct Tally {
  std::int64_t frames = 0;
  std::int64_t gaps = 0;
  FrameTime first_stamp;
  FrameTime last_stamp;

  void add(FrameTime stamp, bool is_gap) {
    if (frames + gaps == 0) first_stamp = stamp;
    last_stamp = stamp;
    ++(is_gap ? gaps : frames);
  }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(last_stamp - first_stamp).count();
  }
};

// "123 frames, 2 gaps, 6.1 s, 20.0 a second, 23.4 MB"
std::string describe(const Tally& tally, std::int64_t bytes) {
  const auto pairs = static_cast<double>(tally.frames + tally.gaps);
  const double seconds = tally.seconds();
  const std::string rate =
      seconds > 0.0 ? fmt::format(", {:.1f} a second", (pairs - 1.0) / seconds) : "";
  return fmt::format("{} frames, {} gaps, {:.1f} s{}, {:.1f} MB", tally.frames, tally.gaps, seconds,
                     rate, static_cast<double>(bytes) / kBytesPerMb);
}

// On standard error while a person watches it; gone at the end.
class Progress {
 public:
  ~Progress() {
    if (is_on_) std::fputs(kEraseLine, stderr);
  }
  void show(const Tally& tally, std::int64_t bytes) {
    const MonotonicTime now = read_monotonic_clock();
    if (!is_on_ || now - shown_at_ < kProgressPeriod) return;
    shown_at_ = now;
    const char* more = tally.frames + tally.gaps == 0 ? "; waiting for the camera" : "";
    std::fprintf(stderr, "%s%s%s", kEraseLine, describe(tally, bytes).c_str(), more);
    std::fflush(stderr);
  }

 private:
  bool is_on_ = is_stderr_terminal();
  MonotonicTime shown_at_;
};

Result<void> check_output(const RecordOptions& options, const std::string& camera) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(options.output, error)) return {};
  if (fs::is_directory(options.output, error)) {
    return failure(ExitCode::kUsage, options.output + ": is a folder; name a file in it");
  }
  if (fs::equivalent(options.output, camera, error)) {
    return failure(ExitCode::kUsage, options.output + ": is what would be recorded from");
  }
  if (options.is_forced) return {};
  return failure(ExitCode::kUsage,
                 options.output + ": exists; name a new file, or add --force to write over it");
}

Result<FrameLogWriter> create_log(const RecordOptions& options, const Config& config,
                                  const LiveCamera& camera) {
  rig_t record = to_rig_record(camera.rig);
  record.source = name_injected(camera.name, options.injections);
  record.config = format_config(config);
  record.version = DARKLING_VERSION;
  constexpr std::int64_t kBytesPerLimit = 1'000'000;
  return FrameLogWriter::create(options.output, record,
                                config.service.record_limit_mb * kBytesPerLimit);
}

// Of a stamp by CLOCK_MONOTONIC.
std::int64_t utime_of(FrameTime stamp) {
  const Duration epoch_offset =
      read_epoch_clock().time_since_epoch() - read_monotonic_clock().time_since_epoch();
  return (stamp.time_since_epoch() + epoch_offset).count() / 1000;
}

Result<void> write(FrameLogWriter& log, const WaitResult& next, Tally& tally) {
  const bool is_gap = next.status == WaitStatus::kBadFrame;
  const FrameTime stamp = is_gap ? next.stamp : next.lease.frame().stamp;
  auto written = is_gap ? log.add_gap(next.sequence, stamp, next.fault, utime_of(stamp))
                        : log.add_frame(next.lease.frame(), utime_of(stamp));
  if (written) tally.add(stamp, is_gap);
  return written;
}

tl::unexpected<Error> camera_lost(const LiveCamera& camera) {
  std::string message = camera.name + ": the camera went away";
  for (const std::string& remark : camera.source->remarks()) message += "\n" + remark;
  return failure(ExitCode::kDeviceUnavailable, message);
}

bool is_enough(const RecordOptions& options, const Tally& tally) {
  if (options.frame_count && tally.frames >= *options.frame_count) return true;
  return options.duration && tally.frames + tally.gaps > 0 &&
         tally.last_stamp - tally.first_stamp >= *options.duration;
}

// Until there is enough, a stop is asked for, or something ends it before: that is the error.
Result<void> record_pairs(const RecordOptions& options, LiveCamera& camera, FrameLogWriter& log,
                          Tally& tally) {
  Progress progress;
  MonotonicTime heard_at = read_monotonic_clock();
  while (!is_stop_requested() && !is_enough(options, tally)) {
    const WaitResult next = camera.source->wait_next(kWait);
    const MonotonicTime now = read_monotonic_clock();
    progress.show(tally, log.byte_count());
    if (next.status == WaitStatus::kEndOfSource) return {};
    if (next.status == WaitStatus::kDeviceLost) return camera_lost(camera);
    if (next.status == WaitStatus::kTimeout && now - heard_at > kPatience) {
      return failure(ExitCode::kDeviceUnavailable,
                     camera.name + ": the camera is open but has delivered nothing for 10 s");
    }
    if (next.status != WaitStatus::kFrame && next.status != WaitStatus::kBadFrame) continue;
    heard_at = now;
    if (auto written = write(log, next, tally); !written) return written;
  }
  return {};
}

void print_summary(const RecordOptions& options, const LiveCamera& camera, const Tally& tally,
                   std::int64_t bytes) {
  const SourceStats stats = camera.source->stats();
  std::printf("%s: %s\n", options.output.c_str(), describe(tally, bytes).c_str());
  if (stats.dropped_by_device + stats.device_errors > 0) {
    std::printf("  the device dropped %lld frames and marked %lld as bad\n",
                static_cast<long long>(stats.dropped_by_device),
                static_cast<long long>(stats.device_errors));
  }
  if (stats.stamps_of_future > 0) {
    std::printf("  the device stamped %lld images with a time still to come\n",
                static_cast<long long>(stats.stamps_of_future));
  }
}

}  // namespace

Result<int> record(const RecordOptions& options) {
  const auto config = load_config(options.config_path, options.settings);
  if (!config) return tl::unexpected(config.error());
  if (auto ok = check_output(options, config->camera.source); !ok) {
    return tl::unexpected(ok.error());
  }
  auto camera = open_camera(*config);
  if (!camera) return tl::unexpected(camera.error());
  camera->source = inject_into(std::move(camera->source), camera->rig, options.injections);
  if (auto started = camera->source->start(); !started) return tl::unexpected(started.error());
  for (const std::string& remark : camera->source->remarks()) {
    std::fprintf(stderr, "darkling: %s\n", remark.c_str());
  }
  catch_stop_signals();
  // Not before: without a camera no empty log is left behind.
  auto log = create_log(options, *config, *camera);
  if (!log) return tl::unexpected(log.error());

  Tally tally;
  const auto recorded = record_pairs(options, *camera, *log, tally);
  const auto closed = log->close();
  print_summary(options, *camera, tally, log->byte_count());
  camera->source->stop();
  if (!recorded) return tl::unexpected(recorded.error());
  if (!closed) return tl::unexpected(closed.error());
  // Where nothing else would have ended it, a stop is no interruption.
  const bool is_interrupted = is_stop_requested() && (options.duration || options.frame_count) &&
                              !is_enough(options, tally);
  return is_interrupted ? kInterruptedStatus : 0;
}

}  // namespace darkling
