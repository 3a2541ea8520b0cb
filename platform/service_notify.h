// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/time.h"

namespace darkling {

// What a service tells the one that started it: systemd's notification protocol. Nothing happens
// where nobody listens.
// Thread: any.
void notify_ready();
void notify_reloading();
void notify_stopping();
void feed_watchdog();
// @param text  one line, for people.
void notify_status(const char* text);

// How often the watchdog wants to be fed at least; nothing when there is none. Read at start only.
[[nodiscard]] std::optional<Duration> read_watchdog_period();

}  // namespace darkling
