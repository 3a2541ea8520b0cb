// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "messages/command_t.hpp"
#include "messages/frame_t.hpp"
#include "messages/gap_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/pose_t.hpp"
#include "messages/rig_t.hpp"
#include "messages/status_t.hpp"
#include "messages/truth_t.hpp"
#include "messages/update_t.hpp"
#include "messages/wire.h"

namespace darkling {

// One message of each type with its numbers at the ends of their ranges.
[[nodiscard]] update_t extreme_update();
[[nodiscard]] pose_t extreme_pose();
[[nodiscard]] status_t extreme_status();
[[nodiscard]] command_t extreme_command();
[[nodiscard]] hint_t extreme_hint();
[[nodiscard]] rig_t extreme_rig();
[[nodiscard]] frame_t extreme_frame();
[[nodiscard]] gap_t extreme_gap();
[[nodiscard]] truth_t extreme_truth();

template <class Message>
[[nodiscard]] std::vector<std::byte> encoded(const Message& message) {
  std::vector<std::byte> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  bytes.resize(encode_into(bytes, message));
  return bytes;
}

// Calls `visit(message)` with each of the above.
template <class Visit>
void for_each_message(const Visit& visit) {
  visit(extreme_update());
  visit(extreme_pose());
  visit(extreme_status());
  visit(extreme_command());
  visit(extreme_hint());
  visit(extreme_rig());
  visit(extreme_frame());
  visit(extreme_gap());
  visit(extreme_truth());
}

}  // namespace darkling
