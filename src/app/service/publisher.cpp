// SPDX-License-Identifier: Apache-2.0
#include "app/service/publisher.h"

#include <algorithm>

#include <lcm/lcm.h>

#include "platform/clocks.h"

namespace darkling {

namespace {

constexpr Duration kFirstBackOff = std::chrono::milliseconds(500);
constexpr Duration kLastBackOff = std::chrono::seconds(5);

}  // namespace

void Publisher::Closer::operator()(_lcm_t* lcm) const {
  lcm_destroy(lcm);
}

Publisher::Publisher(const std::string& url, const std::string& prefix)
    : url_(url), prefix_(prefix), back_off_(kFirstBackOff) {
  channel_.reserve(LCM_MAX_CHANNEL_NAME_LENGTH + prefix.size());
}

// LCM gives no handle where no route leads to its group; once it has one, it comes back by itself.
void Publisher::open_when_due(MonotonicTime now) {
  if (lcm_ != nullptr || now < next_attempt_at_) return;
  lcm_.reset(lcm_create(url_.c_str()));
  if (lcm_ != nullptr) return;
  next_attempt_at_ = now + back_off_;
  back_off_ = std::min(2 * back_off_, kLastBackOff);
}

bool Publisher::send(std::string_view channel, std::span<const std::byte> message) {
  channel_.assign(prefix_).append(channel);
  is_working_ = lcm_ != nullptr && !message.empty() &&
                lcm_publish(lcm_.get(), channel_.c_str(), message.data(),
                            static_cast<unsigned>(message.size())) == 0;
  if (!is_working_) ++failures_;
  return is_working_;
}

}  // namespace darkling
