// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "messages/big_endian.h"
#include "messages/checksum.h"
#include "messages/wire.h"
#include "support/message_cases.h"

namespace darkling {
namespace {

TEST(Messages, KeepEveryValueOnTheWay) {
  for_each_message([](const auto& message) {
    SCOPED_TRACE(message.getTypeName());
    const std::vector<std::byte> sent = encoded(message);
    ASSERT_FALSE(sent.empty());
    std::decay_t<decltype(message)> received = {};
    ASSERT_TRUE(decode_from(sent, received));
    EXPECT_EQ(encoded(received), sent);  // bits, as NaN equals nothing
  });
}

TEST(Messages, AreNotWrittenIntoABufferThatIsTooSmall) {
  for_each_message([](const auto& message) {
    std::vector<std::byte> buffer(static_cast<std::size_t>(message.getEncodedSize()) - 1);
    EXPECT_EQ(encode_into(buffer, message), 0u) << message.getTypeName();
  });
}

TEST(Messages, AreRefusedWhenCutOrLengthened) {
  for_each_message([](const auto& message) {
    std::vector<std::byte> bytes = encoded(message);
    std::decay_t<decltype(message)> received = {};
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(decode_from(std::span(bytes).first(size), received))
          << message.getTypeName() << " of " << size << " bytes";
    }
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(decode_from(bytes, received)) << message.getTypeName();
  });
}

TEST(Messages, AreRefusedAsAnotherType) {
  for_each_message([](const auto& sent) {
    const std::vector<std::byte> bytes = encoded(sent);
    for_each_message([&](const auto& other) {
      std::decay_t<decltype(other)> received = {};
      EXPECT_EQ(decode_from(bytes, received), sent.getHash() == other.getHash())
          << sent.getTypeName() << " read as " << other.getTypeName();
    });
  });
}

// Any length of a string or an array may be anything: no crash, and no memory beyond the message's.
TEST(Messages, SurviveEveryInt32InEveryPlace) {
  for_each_message([](const auto& message) {
    const std::vector<std::byte> sent = encoded(message);
    std::decay_t<decltype(message)> received = {};
    for (std::size_t at = 8; at + 4 <= sent.size(); ++at) {
      for (const std::int32_t value : {0, 1, -1, 0x7fffffff, -0x7fffffff - 1, 0x40000000}) {
        std::vector<std::byte> bytes = sent;
        store_big_endian(value, std::span<std::byte>(bytes), at);
        (void)decode_from(bytes, received);
      }
    }
  });
}

TEST(Messages, AreRefusedWithAZeroWithinAString) {
  status_t status = extreme_status();
  std::vector<std::byte> bytes = encoded(status);
  bytes[bytes.size() - 3] = std::byte{0};
  EXPECT_FALSE(decode_from(bytes, status));
}

TEST(Messages, SurviveRandomBytes) {
  std::mt19937 random(1);
  for_each_message([&](const auto& message) {
    std::decay_t<decltype(message)> received = {};
    for (int i = 0; i < 2000; ++i) {
      std::vector<std::byte> bytes(8 + random() % 200);
      for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
      store_big_endian(message.getHash(), std::span<std::byte>(bytes), 0);
      (void)decode_from(bytes, received);
    }
  });
}

TEST(Checksum, ChangesWithEveryBitAndTheLength) {
  std::vector<std::byte> bytes(21);
  const std::uint64_t before = checksum_of(bytes);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
    EXPECT_NE(checksum_of(bytes), before) << bit;
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
  }
  bytes.push_back(std::byte{0});
  EXPECT_NE(checksum_of(bytes), before);
}

// Logs that exist are checked with it: it stays as it is.
TEST(Checksum, IsWhatItWas) {
  std::vector<std::byte> bytes(11);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i + 1);
  EXPECT_EQ(checksum_of(bytes), 0x87c9cb0b46872c3cu);
}

TEST(Checksum, SealsWhatFollowsIt) {
  std::vector<std::byte> bytes = encoded(extreme_gap());
  seal_record(bytes);
  EXPECT_TRUE(is_record_sound(bytes));
  bytes.back() ^= std::byte{1};
  EXPECT_FALSE(is_record_sound(bytes));
  EXPECT_FALSE(is_record_sound(std::span(bytes).first(15)));
}

TEST(Checksum, SealsTheHeadOfAFrameWithoutItsPixels) {
  std::vector<std::byte> bytes = encoded(extreme_frame());
  seal_frame_head(bytes);
  bytes.back() ^= std::byte{1};
  EXPECT_TRUE(is_frame_head_sound(bytes));
  bytes[kFrameHeadEnd - 1] ^= std::byte{1};
  EXPECT_FALSE(is_frame_head_sound(bytes));
}

}  // namespace
}  // namespace darkling
