// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "app/service/capture_thread.h"
#include "app/service/health.h"
#include "app/service/latency.h"
#include "app/service/odometry_thread.h"
#include "app/service/pipeline_status.h"
#include "app/service/publisher.h"
#include "app/service/recorder.h"
#include "app/service/wall_clock.h"
#include "io/config.h"
#include "io/messages.h"
#include "messages/status_t.hpp"

namespace darkling {

// What of a pipeline stays as it was made.
struct PipelineFacts {
  std::string camera;
  std::string kernels;
  std::string version;
  std::int64_t arena_bytes = 0;
  int width_px = 0;
  int height_px = 0;
  Duration period = {};         // between frames
  int first_reset_counter = 0;  // resets count on from here
};

// Publishes every estimate when it comes, and twice a second how the service is, whatever else
// happens; feeds the watchdog as long as every thread shows signs of life.
class OutputThread {
 public:
  struct Links {
    EstimateRing& estimates;
    WakeUp& own;
    PipelineStatus& status;
    const CaptureThread& capture;
    const FrameSource& source;
    Recorder* recorder;  // may be null
  };
  OutputThread(const Links& links, const PipelineFacts& facts, const ServiceConfig& config,
               std::optional<Duration> watchdog_period);
  // Sends what is left, and a last status.
  ~OutputThread();
  OutputThread(const OutputThread&) = delete;
  OutputThread& operator=(const OutputThread&) = delete;

  // Of the last estimate that was published. Thread: any.
  [[nodiscard]] int reset_counter() const { return reset_counter_; }
  // Counters begin anew at what they are now. Thread: any.
  void zero_counters() { is_zeroing_wanted_ = true; }

 private:
  void serve();
  void publish(TrackedFrame& tracked);
  void keep_alive(MonotonicTime now);
  void judge(MonotonicTime now, bool are_threads_alive);
  void tell_state(MonotonicTime now);
  void publish_status(MonotonicTime now);
  void fill_counts();
  void fill_camera();
  void fill_recording();

  Links links_;
  PipelineFacts facts_;
  MonotonicTime started_at_;
  std::optional<Duration> watchdog_period_;
  bool has_bot_core_pose_;
  std::atomic<int> reset_counter_;
  std::atomic<bool> is_zeroing_wanted_ = false;
  std::atomic<bool> is_stopping_ = false;

  Publisher publisher_;
  EstimateMessages messages_;
  status_t status_ = {};
  status_t zero_ = {};  // counts that status_ is relative to
  Health health_;
  ServiceState state_ = ServiceState::kUnknown;
  WallClock wall_clock_;
  Latency latency_;
  std::int64_t frames_tracked_ = 0;
  std::int64_t frames_lost_ = 0;
  std::int64_t deadline_misses_ = 0;
  MonotonicTime fed_at_;
  MonotonicTime status_at_;
  std::int64_t pairs_in_before_ = 0;  // at the last status
  std::int64_t estimates_before_ = 0;
  std::int64_t skipped_before_ = 0;
  std::int64_t not_recorded_before_ = 0;
  std::string told_error_;  // of the camera
  std::thread thread_;      // last: it uses all of the above
};

}  // namespace darkling
