// SPDX-License-Identifier: Apache-2.0
// The fuzzers' targets under random damage; tests/fuzz/run.sh searches for longer and better.
#include "support/hostile_input.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/message_cases.h"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"

namespace darkling::test {
namespace {

constexpr int kRounds = 3000;

std::vector<std::byte> tiny_log_bytes() {
  const TemporaryFolder folder;
  write_tiny_frame_log(folder / "run.lcmlog");
  const std::string text = read_text(folder / "run.lcmlog");
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

// A few bytes changed, a piece removed, doubled or moved, or the end cut off.
void damage(std::vector<std::byte>& bytes, std::mt19937& random) {
  const std::size_t at = random() % bytes.size();
  const std::size_t length = 1 + random() % std::min<std::size_t>(bytes.size() - at, 64);
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto last = first + static_cast<std::ptrdiff_t>(length);
  const std::vector<std::byte> piece(first, last);
  const auto elsewhere = [&] {
    return bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size());
  };
  switch (random() % 5) {
    case 0:
      for (auto byte = first; byte != last; ++byte) *byte = static_cast<std::byte>(random());
      break;
    case 1:
      *first ^= std::byte{1} << random() % 8;
      break;
    case 2:
      if (bytes.size() > length) bytes.erase(first, last);
      break;
    case 3:
      bytes.insert(elsewhere(), piece.begin(), piece.end());
      break;
    default:
      if (random() % 8 == 0) bytes.resize(at + 1);
  }
}

template <class Target>
void try_damaged(const std::vector<std::byte>& sound, const Target& target, int rounds,
                 std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> bytes = sound;
    for (unsigned i = 0; i <= random() % 6; ++i) damage(bytes, random);
    ASSERT_NO_THROW(target(bytes)) << "seed " << seed << ", round " << round;
  }
}

TEST(HostileInput, DoesNotBreakTheFrameLogReader) {
  try_damaged(tiny_log_bytes(), play_anything, kRounds, 1);
}

TEST(HostileInput, DoesNotBreakTheMessageDecoders) {
  std::uint32_t seed = 2;
  for_each_message([&seed](const auto& message) {
    try_damaged(encoded(message), decode_anything, kRounds, seed++);
  });
}

// What is right is played and decoded: else the above would be about refusals only.
TEST(HostileInput, IsToldFromASoundLog) {
  EXPECT_EQ(play_anything(tiny_log_bytes()), kTinyFrames);
  std::vector<std::byte> empty = tiny_log_bytes();
  empty.resize(empty.size() / 100);
  EXPECT_EQ(play_anything(empty), 0);
}

TEST(HostileInput, IsToldFromASoundMessage) {
  for_each_message([](const auto& message) {
    std::vector<std::byte> bytes = encoded(message);
    EXPECT_EQ(decode_anything(bytes), 1);
    bytes.pop_back();
    EXPECT_EQ(decode_anything(bytes), 0);
  });
}

}  // namespace
}  // namespace darkling::test
