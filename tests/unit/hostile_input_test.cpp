// SPDX-License-Identifier: Apache-2.0
// The fuzzers' targets under random damage; tests/fuzz/run.sh searches for longer and better.
#include "support/hostile_input.h"

#include <vector>

#include <gtest/gtest.h>

#include "drivers/camera/jpeg_luma.h"
#include "support/jpeg_images.h"
#include "support/message_cases.h"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"
#include "support/try_damaged.h"

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

TEST(HostileInput, DoesNotBreakTheFrameLogReader) {
  try_damaged(tiny_log_bytes(), play_anything, kRounds, 1);
}

TEST(HostileInput, DoesNotBreakTheMessageDecoders) {
  std::uint32_t seed = 2;
  for_each_message([&seed](const auto& message) {
    try_damaged(encoded(message), decode_anything, kRounds, seed++);
  });
}

TEST(HostileInput, DoesNotBreakTheDecoderOfJpegs) {
  if (!can_decode_jpeg()) GTEST_SKIP() << "built without libjpeg";
  const auto jpeg = jpeg_image(32, 16, {.is_colour = true});
  const auto bytes = std::as_bytes(std::span(jpeg));
  const std::vector<std::byte> sound(bytes.begin(), bytes.end());
  try_damaged(sound, decode_any_jpeg, kRounds, 3);
  EXPECT_TRUE(decode_any_jpeg(sound));
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
