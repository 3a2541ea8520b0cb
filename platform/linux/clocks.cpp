// SPDX-License-Identifier: Apache-2.0
#include "platform/clocks.h"

#include <cerrno>
#include <ctime>

#include <sys/timex.h>

#include "base/check.h"

namespace darkling {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

Duration read_clock(clockid_t clock) {
  timespec now = {};
  CHECK(clock_gettime(clock, &now) == 0, "the kernel has this clock");
  return Duration{now.tv_sec * kNsPerSecond + now.tv_nsec};
}

}  // namespace

MonotonicTime read_monotonic_clock() {
  return MonotonicTime{read_clock(CLOCK_MONOTONIC)};
}

EpochTime read_epoch_clock() {
  return EpochTime{read_clock(CLOCK_REALTIME)};
}

Duration read_suspended_time() {
  const Duration before = read_clock(CLOCK_MONOTONIC);
  const Duration since_boot = read_clock(CLOCK_BOOTTIME);
  const Duration between = (read_clock(CLOCK_MONOTONIC) - before) / 2;
  const Duration ahead = since_boot - before - between;
  return ahead < std::chrono::milliseconds(1) ? Duration::zero() : ahead;
}

Duration read_thread_cpu_time() {
  return read_clock(CLOCK_THREAD_CPUTIME_ID);
}

bool sleep_until(MonotonicTime wake_at) {
  timespec until = {};
  until.tv_sec = static_cast<time_t>(to_ns(wake_at) / kNsPerSecond);
  until.tv_nsec = static_cast<long>(to_ns(wake_at) % kNsPerSecond);
  return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != EINTR;
}

std::optional<bool> is_epoch_clock_synchronised() {
  timex state = {};  // modes = 0: only asks
  const int result = adjtimex(&state);
  if (result < 0) return std::nullopt;
  return result != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
}

}  // namespace darkling
