// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/service/heartbeat.h"
#include "vo/estimate.h"

namespace darkling {

// A count that one thread keeps and others read.
class Count {
 public:
  void add(std::int64_t n = 1) { value_.fetch_add(n, std::memory_order_relaxed); }
  void set(std::int64_t n) { value_.store(n, std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t get() const { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::int64_t> value_ = 0;
};

// What the service is doing, for people, whenever that changes.
// Thread: any.
class StateLine {
 public:
  void set(const std::string& line) {
    const std::lock_guard lock(mutex_);
    line_ = line;
  }
  // @return the line that was set since the last call, or nothing.
  [[nodiscard]] std::optional<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(line_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<std::string> line_;
};

// What the threads of the service know of each other. Everything counts since the pipeline started.
struct PipelineStatus {
  std::atomic<bool> is_stopping = false;  // from now on, silence means nothing

  // Of the thread that captures:
  Heartbeat capture_heartbeat;
  std::atomic<bool> is_camera_open = false;
  std::atomic<bool> is_first_opening = true;  // nothing is known of the camera yet
  Count camera_openings;
  Count pairs_in;       // whole or not
  Count pairs_refused;  // the odometry had not taken what came before
  std::atomic<bool> is_source_over = false;

  // Of the thread that tracks:
  Heartbeat odometry_heartbeat;
  Count pairs_skipped;  // passed over, a newer one was there
  Count pairs_bad;
  Count estimates_refused;  // the output had not taken those before
  Count refinement_overruns;
  Count heap_calls;  // since it began; -1: not counted
  // Of the thread that publishes:
  Heartbeat output_heartbeat;
  StateLine state_line;

  // Every thread has shown signs of life.
  [[nodiscard]] bool are_threads_alive(MonotonicTime now) const {
    return capture_heartbeat.is_fresh(now) && odometry_heartbeat.is_fresh(now) &&
           output_heartbeat.is_fresh(now);
  }

  // Pairs that were handed over and not given back yet: a source is stopped only when there is
  // none. Given back with release and looked at with acquire, so that who finds none also finds
  // every lease ended.
  std::atomic<std::int64_t> pairs_in_flight = 0;
};

// One estimate on its way out.
struct TrackedFrame {
  Estimate estimate;
  bool is_bad = false;  // there was no usable pair
};

}  // namespace darkling
