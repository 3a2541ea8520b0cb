// SPDX-License-Identifier: Apache-2.0
#include "app/top/heard.h"

#include <utility>

#include "messages/wire.h"

namespace darkling {

namespace {

// The message in `bytes`, or nothing, and that is counted.
template <class Message>
std::optional<Message> decode(std::span<const std::byte> bytes, std::int64_t& malformed) {
  Message message = {};
  if (decode_from(bytes, message)) return message;
  ++malformed;
  return std::nullopt;
}

}  // namespace

void Heard::take_status(std::span<const std::byte> bytes, MonotonicTime now) {
  auto message = decode<status_t>(bytes, malformed);
  if (!message) return;
  status = std::move(message);
  status_at = now;
}

void Heard::take_pose(std::span<const std::byte> bytes, MonotonicTime now) {
  auto message = decode<pose_t>(bytes, malformed);
  if (!message) return;
  pose = message;
  pose_at = now;
  const Vector3 position(pose->translation[0], pose->translation[1], pose->translation[2]);
  constexpr double kFarthest_m = 1e7;  // beyond it nothing drives, and a map has no scale
  // A held or predicted pose is no place where the vehicle was measured to be.
  const bool is_measured =
      pose->status == pose_t::STATUS_VALID || pose->status == pose_t::STATUS_DEGRADED;
  if (is_measured && position.allFinite() && position.norm() < kFarthest_m)
    track.add(position, pose->reset_counter);
}

void Heard::take_update(std::span<const std::byte> bytes) {
  if (auto message = decode<update_t>(bytes, malformed)) update = message;
}

}  // namespace darkling
