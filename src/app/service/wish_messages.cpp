// SPDX-License-Identifier: Apache-2.0
#include "app/service/wish_messages.h"

#include <algorithm>
#include <array>

#include "messages/channels.h"
#include "messages/command_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/wire.h"

namespace darkling {

namespace {

template <class Message>
Result<void> add(FrameLogWriter& log, const char* channel, const Message& message,
                 FrameTime stamp) {
  std::array<std::byte, 256> bytes;
  return log.add_message(channel, std::span(bytes).first(encode_into(std::span(bytes), message)),
                         stamp);
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

}  // namespace darkling
