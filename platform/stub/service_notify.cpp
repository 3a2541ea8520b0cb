// SPDX-License-Identifier: Apache-2.0
// Where there is no systemd, nobody listens.
#include "platform/service_notify.h"

namespace darkling {

void notify_ready() {}
void notify_reloading() {}
void notify_stopping() {}
void feed_watchdog() {}
void notify_status(const char*) {}

std::optional<Duration> read_watchdog_period() {
  return std::nullopt;
}

}  // namespace darkling
