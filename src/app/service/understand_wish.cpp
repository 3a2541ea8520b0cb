// SPDX-License-Identifier: Apache-2.0
#include "app/service/understand_wish.h"

#include <cmath>
#include <numbers>

#include "messages/hint_t.hpp"
#include "messages/wire.h"

namespace darkling {

namespace {

constexpr double kMostTranslation_m = 10.0;
constexpr double kMostRotation_rad = std::numbers::pi / 2;
constexpr double kMostNormError = 1e-3;  // of the quaternion

// All comparisons are false for what is no number.
bool is_rigid(const hint_t& hint) {
  const Eigen::Quaterniond q(hint.rotation[0], hint.rotation[1], hint.rotation[2],
                             hint.rotation[3]);
  const Vector3 t(hint.translation[0], hint.translation[1], hint.translation[2]);
  return std::abs(q.norm() - 1.0) < kMostNormError && t.norm() < kMostTranslation_m &&
         2.0 * std::atan2(q.vec().norm(), std::abs(q.w())) < kMostRotation_rad;
}

bool is_current(const hint_t& hint, EpochTime now) {
  constexpr std::int64_t kMostValid_ms = 10'000;
  if (hint.utime_from >= hint.utime_to || hint.utime_from <= 0) return false;
  if (hint.valid_for_ms < 0 || hint.valid_for_ms > kMostValid_ms) return false;
  const std::int64_t now_us = to_ns(now) / 1000;
  return hint.utime_to <= now_us + kMostValid_ms * 1000 &&
         now_us - hint.utime_to <= std::int64_t{hint.valid_for_ms} * 1000;
}

}  // namespace

std::optional<command_t> understand_command(std::span<const std::byte> message) {
  command_t command = {};
  if (!decode_from(message, command)) return std::nullopt;
  if (command.command <= command_t::COMMAND_UNKNOWN ||
      command.command > command_t::COMMAND_WRITE_BLACK_BOX) {
    return std::nullopt;
  }
  return command;
}

Wish to_wish(const command_t& command) {
  switch (command.command) {
    case command_t::COMMAND_RESET:
      return {.kind = Wish::Kind::kReset};
    case command_t::COMMAND_RESEED:
      return {.kind = Wish::Kind::kReseed};
    default:
      return {};
  }
}

std::optional<Wish> understand_hint(std::span<const std::byte> message, EpochTime now) {
  hint_t hint = {};
  if (!decode_from(message, hint) || !is_rigid(hint) || !is_current(hint, now)) {
    return std::nullopt;
  }
  const Eigen::Quaterniond q(hint.rotation[0], hint.rotation[1], hint.rotation[2],
                             hint.rotation[3]);
  const Vector3 t(hint.translation[0], hint.translation[1], hint.translation[2]);
  Wish wish;
  wish.kind = Wish::Kind::kHint;
  wish.T_previous_body = Se3(q, t);
  wish.span = std::chrono::microseconds(hint.utime_to - hint.utime_from);
  return wish;
}

}  // namespace darkling
