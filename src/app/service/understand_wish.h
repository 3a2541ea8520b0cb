// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "app/service/command_ring.h"
#include "base/time.h"
#include "messages/command_t.hpp"

namespace darkling {

// A message on VO_COMMAND; nothing when it is none, or asks for what is not known.
[[nodiscard]] std::optional<command_t> understand_command(std::span<const std::byte> message);

// What a command asks of the odometry; kNone when it is for others.
[[nodiscard]] Wish to_wish(const command_t& command);

// A message on VO_HINT as a wish; nothing when it is none, is no rigid motion, spans no time, says
// more than a vehicle can do (10 m, or half a turn) or has expired.
[[nodiscard]] std::optional<Wish> understand_hint(std::span<const std::byte> message,
                                                  EpochTime now);

}  // namespace darkling
