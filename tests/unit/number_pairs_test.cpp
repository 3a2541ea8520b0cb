// SPDX-License-Identifier: Apache-2.0
#include "drivers/pairing/number_pairs.h"

#include <gtest/gtest.h>

namespace darkling::test {
namespace {

TEST(FrameIndex, StartsAtNothingWhateverTheDeviceCounts) {
  FrameIndex index;
  EXPECT_EQ(index.advance(4711), 0);
  EXPECT_EQ(index.lost(), 0);
  EXPECT_EQ(index.advance(4712), 1);
}

TEST(FrameIndex, JumpsOverWhatTheDeviceLost) {
  FrameIndex index;
  (void)index.advance(0);
  EXPECT_EQ(index.advance(3), 3);
  EXPECT_EQ(index.lost(), 2);
  EXPECT_EQ(index.advance(4), 4);
  EXPECT_EQ(index.lost(), 0);
}

TEST(FrameIndex, GoesOnOverTheEndOf32Bits) {
  FrameIndex index;
  (void)index.advance(0xFFFFFFFE);
  EXPECT_EQ(index.advance(0xFFFFFFFF), 1);
  EXPECT_EQ(index.advance(1), 3);
  EXPECT_EQ(index.lost(), 1);
}

TEST(FrameIndex, TakesNumbersThatRepeatGoBackOrLeapForANewCount) {
  FrameIndex index;
  (void)index.advance(100);
  EXPECT_EQ(index.advance(100), 1);
  EXPECT_EQ(index.advance(0), 2);
  EXPECT_EQ(index.advance(1), 3);
  EXPECT_EQ(index.advance(2 + FrameIndex::kMaxGap + 1), 4);
  EXPECT_EQ(index.lost(), 0);
  EXPECT_EQ(index.advance(2 + 2 * (FrameIndex::kMaxGap + 1)), 5 + FrameIndex::kMaxGap);
}

TEST(NumberPairs, CountsPairsFromNothing) {
  NumberPairs numbers;
  EXPECT_EQ(numbers.number_pair(0, 0), 0);
  EXPECT_EQ(numbers.number_pair(1, 1), 1);
}

TEST(NumberPairs, LeavesAGapForWhatBothEyesLost) {
  NumberPairs numbers;
  EXPECT_EQ(numbers.number_pair(0, 0), 0);
  EXPECT_EQ(numbers.number_pair(3, 3), 3);
}

TEST(NumberPairs, NumbersAFrameAloneAsThePairThatItWouldHaveMade) {
  NumberPairs numbers;
  EXPECT_EQ(numbers.number_pair(0, 10), 0);  // the right eye had started before
  const auto missing = numbers.number_unpaired(Eye::kRight, 11);
  EXPECT_EQ(missing.number, 1);
  EXPECT_TRUE(missing.is_new);
  EXPECT_EQ(numbers.number_pair(2, 12), 2);  // the left frame 1 was lost
}

TEST(NumberPairs, CountsOneMissingPairWhenBothOfItsFramesAreAlone) {
  NumberPairs numbers;
  EXPECT_EQ(numbers.number_pair(0, 0), 0);
  EXPECT_TRUE(numbers.number_unpaired(Eye::kLeft, 1).is_new);
  EXPECT_FALSE(numbers.number_unpaired(Eye::kRight, 1).is_new);
  EXPECT_EQ(numbers.number_pair(2, 2), 2);
}

TEST(NumberPairs, GrowsAlsoWhenACountLagsBehind) {
  NumberPairs numbers;
  EXPECT_TRUE(numbers.number_unpaired(Eye::kRight, 5).is_new);
  EXPECT_EQ(numbers.number_pair(0, 6), 6);
  EXPECT_EQ(numbers.number_pair(1, 7), 7);
}

TEST(NumberPairs, GoesOnAfterANewStartWithAGapForTheTimeBetween) {
  NumberPairs numbers;
  EXPECT_EQ(numbers.number_pair(0, 0), 0);
  EXPECT_EQ(numbers.number_pair(1, 1), 1);
  numbers.restart(40);
  EXPECT_EQ(numbers.number_pair(0, 0), 42);
  EXPECT_EQ(numbers.number_pair(1, 1), 43);
}

}  // namespace
}  // namespace darkling::test
