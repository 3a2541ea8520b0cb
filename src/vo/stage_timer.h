// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "vo/estimate.h"

namespace darkling {

// Adds the time a stage took to its entry.
class StageTimer {
 public:
  using ReadClock = MonotonicTime (*)();
  StageTimer(ReadClock read_clock, Estimate& estimate, Stage stage)
      : read_clock_(read_clock),
        time_(estimate.stage_times[static_cast<std::size_t>(stage)]),
        start_(read_clock()) {}
  ~StageTimer() { time_ += read_clock_() - start_; }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  ReadClock read_clock_;
  Duration& time_;
  MonotonicTime start_;
};

}  // namespace darkling
