// SPDX-License-Identifier: Apache-2.0
#include "platform/signals.h"

#include <atomic>
#include <csignal>

#include "base/check.h"

namespace darkling {

namespace {

std::atomic<bool> stop_requested = false;
std::atomic<bool> reload_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch it");

void request_stop(int) {
  stop_requested.store(true, std::memory_order_relaxed);
}

void request_reload(int) {
  reload_requested.store(true, std::memory_order_relaxed);
}

}  // namespace

void catch_stop_signals() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  // No SA_RESTART: sleeps and reads wake up. SA_RESETHAND: the second signal is not ours.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  CHECK(sigaction(SIGINT, &action, nullptr) == 0, "SIGINT can be caught");
  CHECK(sigaction(SIGTERM, &action, nullptr) == 0, "SIGTERM can be caught");
}

bool is_stop_requested() {
  return stop_requested.load(std::memory_order_relaxed);
}

void catch_reload_signal() {
  struct sigaction action = {};
  action.sa_handler = request_reload;
  CHECK(sigaction(SIGHUP, &action, nullptr) == 0, "SIGHUP can be caught");
}

bool take_reload_request() {
  return reload_requested.exchange(false, std::memory_order_relaxed);
}

}  // namespace darkling
