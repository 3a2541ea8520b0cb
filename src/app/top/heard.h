// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "app/top/track.h"
#include "base/time.h"
#include "messages/pose_t.hpp"
#include "messages/status_t.hpp"
#include "messages/update_t.hpp"

namespace darkling {

// All that was heard of a service so far: the last message of each kind, and what they add up to.
// Thread: one.
struct Heard {
  std::optional<status_t> status;
  MonotonicTime status_at;  // when it came
  std::optional<pose_t> pose;
  MonotonicTime pose_at;
  std::optional<update_t> update;
  Track track;
  std::int64_t malformed = 0;  // messages on our channels that are none of ours
  // Another service's VO_STATUS channel on the same network, for those who forgot the prefix.
  std::string other_channel;
  // Why nothing can be heard at all; empty: it can.
  std::string no_network;

  // Each takes one message as it came from the network, which may be anything.
  void take_status(std::span<const std::byte> bytes, MonotonicTime now);
  void take_pose(std::span<const std::byte> bytes, MonotonicTime now);
  void take_update(std::span<const std::byte> bytes);
};

}  // namespace darkling
