// SPDX-License-Identifier: Apache-2.0
// What this process, as the user it runs as, may ask of the system; the requests themselves are in
// platform/realtime.h.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace darkling {

// Of SCHED_FIFO: 1…99; 0 when none is allowed.
[[nodiscard]] int read_most_realtime_priority();

// Of memory kept from being paged out; nothing when there is no limit.
[[nodiscard]] std::optional<std::uint64_t> read_most_locked_bytes();

// The numbers of the cores that are online and allowed, rising; empty where the system does not
// tell.
[[nodiscard]] std::vector<int> read_allowed_cores();

}  // namespace darkling
