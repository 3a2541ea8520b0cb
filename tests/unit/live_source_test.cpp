// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gtest/gtest.h>

#include "drivers/live/paced_source.h"
#include "drivers/live/rehearsed_source.h"
#include "platform/clocks.h"

namespace darkling {
namespace {

using std::chrono::milliseconds;

// Frames of 4x2 px whose pixels are their number, 20 ms apart on a clock of their own.
class NumberedSource final : public FrameSource {
 public:
  explicit NumberedSource(int frames) : frames_(frames) {}
  Result<void> start() override {
    next_ = 0;
    return {};
  }
  WaitResult wait_next(Duration) override {
    if (next_ >= frames_) return {.status = WaitStatus::kEndOfSource};
    pixels_.assign(8, static_cast<std::uint8_t>(next_));
    const ImageView<const std::uint8_t> image(pixels_.data(), 4, 2, 4);
    WaitResult result;
    result.status = WaitStatus::kFrame;
    result.lease = FrameLease(
        {.sequence = next_,
         .stamp = frame_time_from_ns(77'000'000 + next_ * 20'000'000),
         .left = image,
         .right = image},
        [](void*, int) {}, nullptr, 0);
    ++next_;
    return result;
  }
  void stop() override {}
  [[nodiscard]] SourceStats stats() const override { return {.delivered = next_}; }

 private:
  int frames_;
  std::int64_t next_ = 0;
  std::vector<std::uint8_t> pixels_;
};

TEST(RehearsedSource, PlaysToAndFroForEver) {
  RehearsedSource source(std::make_unique<NumberedSource>(3), 20.0);
  ASSERT_TRUE(source.start());
  for (const int expected : {0, 1, 2, 1, 0, 1, 2, 1, 0}) {
    const WaitResult next = source.wait_next(milliseconds(0));
    ASSERT_EQ(next.status, WaitStatus::kFrame);
    EXPECT_EQ(*next.lease.frame().left.row(1), expected);
  }
  const WaitResult tenth = source.wait_next(milliseconds(0));
  EXPECT_EQ(tenth.lease.frame().sequence, 9);
  EXPECT_EQ(to_ns(tenth.lease.frame().stamp), 450'000'000);
}

TEST(RehearsedSource, RefusesASceneThatCannotGoBack) {
  RehearsedSource source(std::make_unique<NumberedSource>(1), 20.0);
  const auto started = source.start();
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().message.find("found 1 frames"), std::string::npos);
}

TEST(RehearsedSource, EndsWhereItIsTold) {
  RehearsedSource source(std::make_unique<NumberedSource>(3), 20.0, 4);
  ASSERT_TRUE(source.start());
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(source.wait_next(milliseconds(0)).status, WaitStatus::kFrame);
  }
  EXPECT_EQ(source.wait_next(milliseconds(0)).status, WaitStatus::kEndOfSource);
}

TEST(PacedSource, DeliversWhenItIsTimeAndStampsByTheMonotonicClock) {
  PacedSource source(std::make_unique<NumberedSource>(4));
  ASSERT_TRUE(source.start());
  MonotonicTime first_at;
  for (int i = 0; i < 4; ++i) {
    const WaitResult next = source.wait_next(milliseconds(1000));
    const MonotonicTime now = read_monotonic_clock();
    ASSERT_EQ(next.status, WaitStatus::kFrame);
    if (i == 0) first_at = now;
    EXPECT_GE(now - first_at, milliseconds(20 * i - 1)) << i;  // never early
    EXPECT_LE(to_ns(next.lease.frame().stamp), to_ns(now));
    EXPECT_EQ(next.lease.frame().sequence, i);
  }
  EXPECT_EQ(source.wait_next(milliseconds(1)).status, WaitStatus::kEndOfSource);
}

TEST(PacedSource, TimesOutWithoutLosingTheFrame) {
  PacedSource source(std::make_unique<NumberedSource>(2));
  ASSERT_TRUE(source.start());
  ASSERT_EQ(source.wait_next(milliseconds(100)).status, WaitStatus::kFrame);
  int timeouts = 0;
  WaitResult next = source.wait_next(milliseconds(1));
  while (next.status == WaitStatus::kTimeout) {
    ++timeouts;
    next = source.wait_next(milliseconds(1));
  }
  EXPECT_EQ(next.status, WaitStatus::kFrame);
  EXPECT_EQ(next.lease.frame().sequence, 1);
  EXPECT_GT(timeouts, 0);
}

}  // namespace
}  // namespace darkling
