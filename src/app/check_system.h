// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "app/check_rows.h"
#include "io/config.h"

namespace darkling {

// Adds what the service asks of the machine: a way for its messages, the clock, a priority, locked
// memory, a core, room for recordings. What no key asks for is not checked.
// @param needed_bytes  that the odometry claims; 0: not known.
void check_system(const Config& config, std::uint64_t needed_bytes, CheckRows& rows);

}  // namespace darkling
