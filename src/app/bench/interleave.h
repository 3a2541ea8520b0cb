// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/time.h"

namespace darkling {

// What was measured again and again: the median of the samples, and how far they scatter.
struct Timing {
  double median_ns = 0.0;  // of one call
  double spread = 0.0;     // the 90th percentile over the median, less one
};

struct InterleavePlan {
  int rounds = 21;                                        // samples of each task
  Duration sample_time = std::chrono::microseconds(500);  // of as many calls as fit, at least one
  std::function<void(int done, int rounds)> show = nullptr;  // after every round
};

// Times tasks in turns, one sample of each a round, so that whatever disturbs the machine for a
// while disturbs all of them alike. Every sample is preceded by a call that does not count.
// Time is what the thread had of the processor, and samples are short: on a busy machine most of
// them then lie between two changes of process, and the median is one of those.
[[nodiscard]] std::vector<Timing> measure_interleaved(std::span<const std::function<void()>> tasks,
                                                      const InterleavePlan& plan);

}  // namespace darkling
