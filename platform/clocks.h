// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/time.h"

namespace darkling {

// CLOCK_MONOTONIC. Async-signal-safe, never fails.
[[nodiscard]] MonotonicTime read_monotonic_clock();

// CLOCK_REALTIME. May step; only for labels.
[[nodiscard]] EpochTime read_epoch_clock();

// Whether the system says that CLOCK_REALTIME follows a reference; nothing where it does not tell.
[[nodiscard]] std::optional<bool> is_epoch_clock_synchronised();

// CLOCK_BOOTTIME minus CLOCK_MONOTONIC: for how long the machine has been suspended since it was
// started. Less than a millisecond is no suspension but the time between two readings, and is 0.
[[nodiscard]] Duration read_suspended_time();

// What the calling thread has had of the processor: does not grow while others have it. Costs a
// call of the kernel: 0.5 us on a virtual machine where the other two cost 0.02.
[[nodiscard]] Duration read_thread_cpu_time();

// Sleeps until `wake_at`, or until a signal arrives.
// @return true when `wake_at` was reached.
[[nodiscard]] bool sleep_until(MonotonicTime wake_at);

}  // namespace darkling
