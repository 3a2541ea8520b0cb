// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "base/time.h"
#include "platform/clocks.h"

namespace darkling {

// A sign of life of one thread, which another looks at.
// Thread: beat() and expect_until() from one, is_fresh() from any.
class Heartbeat {
 public:
  Heartbeat() { beat(); }

  void beat() { expect_until(kSilence); }
  // Announces something that may take longer than a beat, as opening a device does.
  void expect_until(Duration from_now) {
    fresh_until_ns_.store(to_ns(read_monotonic_clock() + from_now), std::memory_order_relaxed);
  }
  [[nodiscard]] bool is_fresh(MonotonicTime now) const {
    return to_ns(now) <= fresh_until_ns_.load(std::memory_order_relaxed);
  }

 private:
  // Threads that have nothing to do wake up ten times a second to say so.
  static constexpr Duration kSilence = std::chrono::seconds(1);
  std::atomic<std::int64_t> fresh_until_ns_ = 0;
};

}  // namespace darkling
