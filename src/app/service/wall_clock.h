// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/time.h"

namespace darkling {

// How far the wall clock is ahead of CLOCK_MONOTONIC, and whether somebody has set it. It labels
// messages and is used for nothing else.
// Thread: one.
class WallClock {
 public:
  // @return CLOCK_REALTIME minus CLOCK_MONOTONIC, now.
  Duration update();
  // How often update() found the two more than 100 ms further apart, or nearer, than before.
  [[nodiscard]] std::int64_t steps() const { return steps_; }

  // The same with what the clocks said.
  Duration update(MonotonicTime monotonic, EpochTime epoch);

 private:
  static constexpr Duration kStep = std::chrono::milliseconds(100);

  bool has_offset_ = false;
  Duration offset_ = Duration::zero();
  std::int64_t steps_ = 0;
};

}  // namespace darkling
