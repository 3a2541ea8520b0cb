// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <numeric>

#include <gtest/gtest.h>

#include "base/fixed_vector.h"

namespace darkling {
namespace {

TEST(FixedVector, TakesAsManyAsItsTypeSaysAndNoMore) {
  FixedVector<int, 2> list;
  EXPECT_TRUE(list.is_empty());
  EXPECT_TRUE(list.push_back(1));
  EXPECT_TRUE(list.push_back(2));
  EXPECT_TRUE(list.is_full());
  EXPECT_FALSE(list.push_back(3));
  EXPECT_EQ(list.size(), 2U);
  EXPECT_EQ(list[1], 2);
}

TEST(FixedVector, LeavesARefusedElementWithTheCaller) {
  FixedVector<std::unique_ptr<int>, 1> list;
  ASSERT_TRUE(list.push_back(std::make_unique<int>(1)));
  auto refused = std::make_unique<int>(2);
  EXPECT_FALSE(list.push_back(std::move(refused)));
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(*refused, 2);
}

TEST(FixedVector, IteratesOverWhatItHolds) {
  FixedVector<int, 8> list;
  for (const int number : {1, 2, 3}) ASSERT_TRUE(list.push_back(number));
  EXPECT_EQ(std::accumulate(list.begin(), list.end(), 0), 6);
}

TEST(FixedVector, KeepsTheOrderWhenOneIsTakenOut) {
  FixedVector<int, 4> list;
  for (const int number : {1, 2, 3, 4}) ASSERT_TRUE(list.push_back(number));
  list.erase(1);
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0], 1);
  EXPECT_EQ(list[1], 3);
  EXPECT_EQ(list[2], 4);
}

TEST(FixedVector, LetsGoWhatATakenOutElementOwned) {
  const auto owned = std::make_shared<int>(5);
  FixedVector<std::shared_ptr<int>, 4> list;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(list.push_back(owned));
  EXPECT_EQ(owned.use_count(), 4);
  list.pop_back();
  EXPECT_EQ(owned.use_count(), 3);
  list.erase(0);
  EXPECT_EQ(owned.use_count(), 2);
  list.clear();
  EXPECT_EQ(owned.use_count(), 1);
}

TEST(FixedVectorDeath, AbortsBeyondItsEnd) {
  FixedVector<int, 4> list;
  ASSERT_TRUE(list.push_back(1));
  EXPECT_DEATH(static_cast<void>(list[1]), "beyond the end");
  EXPECT_DEATH(list.erase(1), "beyond the end");
}

TEST(FixedVectorDeath, AbortsWhenAnEmptyListIsAskedForAnElement) {
  FixedVector<int, 4> list;
  EXPECT_DEATH(list.pop_back(), "empty list");
}

}  // namespace
}  // namespace darkling
