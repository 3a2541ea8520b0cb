// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "base/spsc_ring.h"

namespace darkling {
namespace {

TEST(SpscRing, GivesBackInOrderWhatWasPutIn) {
  SpscRing<int, 3> ring;
  for (int round = 0; round < 5; ++round) {  // goes round the end of its places
    EXPECT_TRUE(ring.try_push(2 * round));
    EXPECT_TRUE(ring.try_push(2 * round + 1));
    EXPECT_EQ(ring.try_pop(), 2 * round);
    EXPECT_EQ(ring.try_pop(), 2 * round + 1);
  }
  EXPECT_EQ(ring.try_pop(), std::nullopt);
}

TEST(SpscRing, RefusesWhenFullAndLeavesTheElementWithTheCaller) {
  SpscRing<std::unique_ptr<int>, 2> ring;
  ASSERT_TRUE(ring.try_push(std::make_unique<int>(1)));
  ASSERT_TRUE(ring.try_push(std::make_unique<int>(2)));
  auto refused = std::make_unique<int>(3);
  EXPECT_FALSE(ring.try_push(std::move(refused)));
  ASSERT_NE(refused, nullptr);
  ASSERT_TRUE(ring.try_pop().has_value());
  EXPECT_TRUE(ring.try_push(std::move(refused)));
}

TEST(SpscRing, HandsTheNewestAndCountsTheOlderAsSkipped) {
  SpscRing<int, 4> ring;
  std::int64_t skipped = 0;
  EXPECT_EQ(ring.pop_newest(skipped), std::nullopt);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(ring.try_push(int(i)));
  EXPECT_EQ(ring.pop_newest(skipped), 3);
  EXPECT_EQ(skipped, 3);
  ASSERT_TRUE(ring.try_push(9));
  EXPECT_EQ(ring.pop_newest(skipped), 9);
  EXPECT_EQ(skipped, 3);
}

TEST(SpscRing, LetsGoWhatSkippedElementsOwned) {
  const auto owned = std::make_shared<int>(5);
  SpscRing<std::shared_ptr<int>, 4> ring;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(ring.try_push(std::shared_ptr<int>(owned)));
  std::int64_t skipped = 0;
  EXPECT_TRUE(ring.pop_newest(skipped).has_value());
  EXPECT_EQ(owned.use_count(), 1);
}

TEST(SpscRing, LosesAndReordersNothingBetweenTwoThreads) {
  constexpr int kCount = 200'000;
  SpscRing<std::unique_ptr<int>, 8> ring;
  std::thread producer([&ring] {
    for (int i = 0; i < kCount; ++i) {
      auto number = std::make_unique<int>(i);
      while (!ring.try_push(std::move(number))) std::this_thread::yield();
    }
  });
  int out_of_order = 0;
  for (int expected = 0; expected < kCount;) {
    const auto number = ring.try_pop();
    if (!number) {
      std::this_thread::yield();
      continue;
    }
    if (**number != expected) ++out_of_order;
    ++expected;
  }
  producer.join();
  EXPECT_EQ(out_of_order, 0);
  EXPECT_EQ(ring.try_pop(), std::nullopt);
}

TEST(SpscRing, HandsEveryElementOnOrCountsItAsSkippedBetweenTwoThreads) {
  constexpr int kCount = 200'000;
  SpscRing<int, 8> ring;
  std::thread producer([&ring] {
    for (int i = 0; i < kCount; ++i) {
      while (!ring.try_push(int(i))) std::this_thread::yield();
    }
  });
  std::int64_t skipped = 0;
  std::int64_t taken = 0;
  int last = -1;
  bool is_ascending = true;
  while (last < kCount - 1) {
    const auto newest = ring.pop_newest(skipped);
    if (!newest) {
      std::this_thread::yield();
      continue;
    }
    is_ascending = is_ascending && *newest > last;
    last = *newest;
    ++taken;
  }
  producer.join();
  EXPECT_TRUE(is_ascending);
  EXPECT_EQ(taken + skipped, kCount);
}

}  // namespace
}  // namespace darkling
