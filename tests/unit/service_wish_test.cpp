// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "app/service/understand_wish.h"
#include "messages/hint_t.hpp"
#include "messages/wire.h"

namespace darkling {
namespace {

constexpr std::int64_t kNow_us = 1'800'000'000'000'000;

EpochTime now() {
  return EpochTime(std::chrono::microseconds(kNow_us));
}

hint_t good_hint() {
  hint_t hint = {};
  hint.utime_from = kNow_us - 60'000;
  hint.utime_to = kNow_us - 10'000;
  hint.valid_for_ms = 100;
  hint.translation[0] = 0.2;
  hint.rotation[0] = 1.0;
  return hint;
}

std::optional<Wish> understand(const hint_t& hint) {
  std::array<std::byte, 256> bytes;
  const std::size_t size = encode_into(std::span(bytes), hint);
  return understand_hint(std::span(bytes).first(size), now());
}

TEST(UnderstandHint, TakesAMotionWithItsSpan) {
  const auto wish = understand(good_hint());
  ASSERT_TRUE(wish);
  EXPECT_EQ(wish->kind, Wish::Kind::kHint);
  EXPECT_EQ(wish->T_previous_body.translation(), Vector3(0.2, 0.0, 0.0));
  EXPECT_EQ(wish->span, std::chrono::milliseconds(50));
}

TEST(UnderstandHint, RefusesWhatIsNoMotionOfAVehicle) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 10.1, -1e300}) {
    hint_t hint = good_hint();
    hint.translation[1] = bad;
    EXPECT_FALSE(understand(hint)) << bad;
  }
  for (const double bad : {nan, infinite, 0.0, 0.9, 1.1}) {
    hint_t hint = good_hint();
    hint.rotation[0] = bad;
    EXPECT_FALSE(understand(hint)) << bad;
  }
  hint_t turned = good_hint();
  turned.rotation[0] = std::cos(1.0);
  turned.rotation[3] = std::sin(1.0);  // 115 degrees
  EXPECT_FALSE(understand(turned));
}

TEST(UnderstandHint, RefusesTimesThatMakeNoSense) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  struct Times {
    std::int64_t from;
    std::int64_t to;
    std::int32_t valid_for_ms;
  };
  for (const Times& times : {Times{kNow_us, kNow_us, 100},                       // no time at all
                             Times{kNow_us, kNow_us - 1000, 100},                // backwards
                             Times{0, kNow_us, 100}, Times{-kMost, kMost, 100},  // absurd
                             Times{kNow_us, kMost, 100},                         // from the future
                             Times{kNow_us - 900'000, kNow_us - 800'000, 100},   // expired
                             Times{kNow_us - 60'000, kNow_us - 10'000, -1},
                             Times{kNow_us - 60'000, kNow_us - 10'000, 2'000'000'000}}) {
    hint_t hint = good_hint();
    hint.utime_from = times.from;
    hint.utime_to = times.to;
    hint.valid_for_ms = times.valid_for_ms;
    EXPECT_FALSE(understand(hint)) << times.from << " " << times.to;
  }
}

TEST(UnderstandCommand, TakesKnownOnesOnly) {
  for (int command = -128; command < 128; ++command) {
    command_t message = {};
    message.command = static_cast<std::int8_t>(command);
    std::array<std::byte, 64> bytes;
    const std::size_t size = encode_into(std::span(bytes), message);
    const auto understood = understand_command(std::span(bytes).first(size));
    EXPECT_EQ(understood.has_value(),
              command >= command_t::COMMAND_RESET && command <= command_t::COMMAND_WRITE_BLACK_BOX)
        << command;
    EXPECT_FALSE(understand_command(std::span(bytes).first(size - 1)));
  }
  EXPECT_FALSE(understand_command({}));
}

}  // namespace
}  // namespace darkling
