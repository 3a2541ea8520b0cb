// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/time.h"
#include "platform/clocks.h"

namespace darkling {

enum class Pace { kFast, kRecorded };

// Holds frames back until as much time has passed since the first as when they were taken.
class Pacer {
 public:
  explicit Pacer(Pace pace) : pace_(pace) {}

  // Returns at once when fast, when late, or when a signal arrives.
  void wait_for(FrameTime stamp) {
    if (pace_ == Pace::kFast) return;
    if (!has_started_) {
      has_started_ = true;
      first_stamp_ = stamp;
      first_at_ = read_monotonic_clock();
    }
    static_cast<void>(sleep_until(first_at_ + (stamp - first_stamp_)));
  }

 private:
  Pace pace_;
  bool has_started_ = false;
  FrameTime first_stamp_;
  MonotonicTime first_at_;
};

}  // namespace darkling
