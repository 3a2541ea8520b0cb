// SPDX-License-Identifier: Apache-2.0
#include "app/top/listener.h"

#include <algorithm>
#include <cerrno>

#include <lcm/lcm.h>

#include "messages/channel_pattern.h"
#include "messages/channels.h"
#include "platform/clocks.h"
#include "platform/signals.h"

namespace darkling {

namespace {

constexpr Duration kBackOff = std::chrono::seconds(2);
constexpr Duration kLongestWait = std::chrono::milliseconds(100);  // how late a stop may be seen

std::span<const std::byte> bytes_of(const lcm_recv_buf_t* received) {
  return {static_cast<const std::byte*>(received->data), received->data_size};
}

}  // namespace

void Listener::Closer::operator()(_lcm_t* lcm) const {
  lcm_destroy(lcm);
}

Listener::Listener(const std::string& url, const std::string& prefix)
    : url_(url), prefix_(prefix), status_channel_(prefix + kStatusChannel) {}

// LCM gives no handle where no route leads to its group; once it has one, it comes back by itself.
void Listener::open_when_due(MonotonicTime now) {
  if (lcm_ != nullptr || now < next_attempt_at_) return;
  lcm_.reset(lcm_create(url_.c_str()));
  heard_.no_network = lcm_ != nullptr ? "" : "LCM cannot be had on " + url_;
  if (lcm_ == nullptr) {
    next_attempt_at_ = read_monotonic_clock() + kBackOff;
    return;
  }
  const std::string prefix = escape_channel(prefix_);
  lcm_subscribe(lcm_.get(), (std::string(".*") + kStatusChannel).c_str(), on_status, this);
  lcm_subscribe(lcm_.get(), (prefix + kPoseChannel).c_str(), on_pose, this);
  lcm_subscribe(lcm_.get(), (prefix + kUpdateChannel).c_str(), on_update, this);
}

void Listener::listen(MonotonicTime until) {
  for (MonotonicTime now = read_monotonic_clock(); now < until && !is_stop_requested();
       now = read_monotonic_clock()) {
    open_when_due(now);
    const Duration wait = std::min<Duration>(until - now, kLongestWait);
    if (lcm_ == nullptr) {
      static_cast<void>(sleep_until(now + wait));
      continue;
    }
    const auto wait_ms = std::chrono::ceil<std::chrono::milliseconds>(wait).count();
    errno = 0;
    if (lcm_handle_timeout(lcm_.get(), static_cast<int>(wait_ms)) < 0 && errno != EINTR) {
      lcm_.reset();
      next_attempt_at_ = now + kBackOff;
      heard_.no_network = "the connection to " + url_ + " broke";
    }
  }
}

void Listener::on_status(const lcm_recv_buf_t* received, const char* channel, void* user) {
  auto& self = *static_cast<Listener*>(user);
  if (channel == self.status_channel_) {
    self.heard_.take_status(bytes_of(received), read_monotonic_clock());
  } else {
    self.heard_.other_channel = channel;
  }
}

void Listener::on_pose(const lcm_recv_buf_t* received, const char*, void* user) {
  static_cast<Listener*>(user)->heard_.take_pose(bytes_of(received), read_monotonic_clock());
}

void Listener::on_update(const lcm_recv_buf_t* received, const char*, void* user) {
  static_cast<Listener*>(user)->heard_.take_update(bytes_of(received));
}

}  // namespace darkling
