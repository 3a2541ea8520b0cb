// SPDX-License-Identifier: Apache-2.0
#include "app/service/wish_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "app/service/understand_wish.h"
#include "messages/channels.h"
#include "messages/command_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/wire.h"

namespace darkling {

namespace {

constexpr std::size_t kMaxMessage = 256;  // bytes of a command or hint; longer: it is neither
// What the service obeys at most, 10 m along an arc of 90 degrees, at ten times its pace.
constexpr double kMostTranslation_m = 112.0;
constexpr double kMostNormError = 1e-9;  // of the quaternion, of which nothing was rounded

template <class Message>
Result<void> add(FrameLogWriter& log, const char* channel, const Message& message,
                 FrameTime stamp) {
  std::array<std::byte, kMaxMessage> bytes;
  return log.add_message(channel, std::span(bytes).first(encode_into(std::span(bytes), message)),
                         stamp);
}

// Unlike one that arrives, a recorded hint is not weighed again: it was already found to be good,
// and is at the pace of its pair. All comparisons are false for what is no number.
std::optional<Wish> read_hint(std::span<const std::byte> message) {
  hint_t hint = {};
  if (!decode_from(message, hint)) return std::nullopt;
  const Eigen::Quaterniond q(hint.rotation[0], hint.rotation[1], hint.rotation[2],
                             hint.rotation[3]);
  const Vector3 t(hint.translation[0], hint.translation[1], hint.translation[2]);
  const bool is_rigid = std::abs(q.norm() - 1.0) < kMostNormError && t.norm() < kMostTranslation_m;
  if (!is_rigid) return std::nullopt;
  return Wish{.kind = Wish::Kind::kHint, .T_previous_body = Se3::from_unit(q, t)};
}

std::optional<Wish> read_wish(const FrameLog& log, const FrameLogMessage& message) {
  std::array<std::byte, kMaxMessage> buffer;
  const auto size = static_cast<std::size_t>(message.data_size);
  if (size > buffer.size()) return std::nullopt;
  const auto bytes = std::span(buffer).first(size);
  if (!log.events.read_at(message.data_at, bytes)) return std::nullopt;
  if (message.channel == std::string_view(kHintChannel)) return read_hint(bytes);
  const std::optional<command_t> command = understand_command(bytes);
  return command ? std::optional(to_wish(*command)) : std::nullopt;
}

}  // namespace

Result<void> add_wish(FrameLogWriter& log, const Wish& wish, FrameTime stamp,
                      std::int64_t utime_us) {
  if (wish.kind == Wish::Kind::kHint) {
    hint_t hint = {};
    hint.utime_to = utime_us;
    hint.utime_from = utime_us - wish.span.count() / 1000;
    std::copy_n(wish.T_previous_body.translation().data(), 3, hint.translation);
    const Eigen::Quaterniond& q = wish.T_previous_body.rotation();
    const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
    std::copy(wxyz.begin(), wxyz.end(), hint.rotation);
    return add(log, kHintChannel, hint, stamp);
  }
  command_t command = {};
  command.utime = utime_us;
  command.command = wish.kind == Wish::Kind::kReset    ? command_t::COMMAND_RESET
                    : wish.kind == Wish::Kind::kReseed ? command_t::COMMAND_RESEED
                                                       : command_t::COMMAND_UNKNOWN;
  return add(log, kCommandChannel, command, stamp);
}

Result<void> add_wishes(FrameLogWriter& log, std::span<const RecordedWish> wishes,
                        FrameTime stamp) {
  for (const RecordedWish& recorded : wishes) {
    if (auto added = add_wish(log, recorded.wish, stamp, /*utime_us=*/0); !added) return added;
  }
  return {};
}

RecordedWishes read_wishes(const FrameLog& log) {
  RecordedWishes recorded;
  for (const FrameLogMessage& message : log.messages) {
    const std::optional<Wish> wish = read_wish(log, message);
    recorded.unreadable += wish ? 0 : 1;
    if (!wish || wish->kind == Wish::Kind::kNone || message.row == log.rows.size()) continue;
    recorded.wishes.push_back({.sequence = log.rows[message.row].sequence, .wish = *wish});
  }
  return recorded;
}

}  // namespace darkling
