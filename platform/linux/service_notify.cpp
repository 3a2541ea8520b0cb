// SPDX-License-Identifier: Apache-2.0
#include "platform/service_notify.h"

#include <cstdint>
#include <cstdio>

#include <systemd/sd-daemon.h>

namespace darkling {

namespace {

// What cannot be delivered is not worth stopping for.
void send(const char* state) {
  static_cast<void>(sd_notify(/*unset_environment=*/0, state));
}

}  // namespace

void notify_ready() {
  send("READY=1");
}

void notify_reloading() {
  send("RELOADING=1");
}

void notify_stopping() {
  send("STOPPING=1");
}

void feed_watchdog() {
  send("WATCHDOG=1");
}

void notify_status(const char* text) {
  char state[256];
  std::snprintf(state, sizeof(state), "STATUS=%s", text);
  send(state);
}

std::optional<Duration> read_watchdog_period() {
  std::uint64_t period_us = 0;
  if (sd_watchdog_enabled(/*unset_environment=*/0, &period_us) <= 0) return std::nullopt;
  return std::chrono::microseconds(period_us);
}

}  // namespace darkling
