// SPDX-License-Identifier: Apache-2.0
// One time type per clock, so that a wall-clock stamp never meets a monotonic one by accident.
// All count integer nanoseconds: 32-bit seconds times 1e6 and doubles of epoch seconds lose time.
#pragma once

#include <chrono>
#include <cstdint>

namespace darkling {

using Duration = std::chrono::nanoseconds;

// CLOCK_MONOTONIC: rates, deadlines, heartbeats. Read by platform/clocks.h only.
struct MonotonicClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  static constexpr bool is_steady = true;
};
using MonotonicTime = std::chrono::time_point<MonotonicClock, Duration>;

// CLOCK_REALTIME, nanoseconds since 1970: only to label what leaves the machine; it may step.
struct EpochClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  static constexpr bool is_steady = false;
};
using EpochTime = std::chrono::time_point<EpochClock, Duration>;

// The clock the frames of one source are stamped by: CLOCK_MONOTONIC on live cameras, whatever the
// recording used in a replay (epoch nanoseconds in EuRoC, seconds from the first frame in KITTI).
struct FrameClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  static constexpr bool is_steady = false;
};
using FrameTime = std::chrono::time_point<FrameClock, Duration>;

[[nodiscard]] constexpr FrameTime frame_time_from_ns(std::int64_t ns) {
  return FrameTime{Duration{ns}};
}

template <class Clock>
[[nodiscard]] constexpr std::int64_t to_ns(std::chrono::time_point<Clock, Duration> t) {
  return t.time_since_epoch().count();
}

}  // namespace darkling
