// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gtest/gtest.h>

#include "drivers/injection/injected_source.h"
#include "support/plain_source.h"

namespace darkling {
namespace {

using test::drifting_pairs;
using test::inject;
using test::PlainPair;
using Pixels = std::vector<std::uint8_t>;

constexpr ImageSize kSize{.width = 40, .height = 30};
constexpr std::ptrdiff_t kHalf = 15 * 40;

int count_lost(const std::vector<PlainPair>& pairs) {
  return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [](const PlainPair& pair) {
    return pair.fault == FrameFault::kUnreadable;
  }));
}

bool has_upper_half(const Pixels& image, const Pixels& of) {
  return std::equal(image.begin(), image.begin() + kHalf, of.begin());
}

bool has_lower_half(const Pixels& image, const Pixels& of) {
  return std::equal(image.begin() + kHalf, image.end(), of.begin() + kHalf);
}

TEST(InjectDrop, LosesPairsWithItsProbability) {
  const auto pairs = drifting_pairs(kSize, 400);
  const auto dropped = inject(kSize, pairs, {"drop=0.25"});
  ASSERT_EQ(dropped.size(), pairs.size());
  EXPECT_NEAR(count_lost(dropped), 100, 45) << "five standard deviations";
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(dropped[i].sequence, pairs[i].sequence);
    EXPECT_EQ(dropped[i].stamp, pairs[i].stamp);
    EXPECT_TRUE(dropped[i].fault != FrameFault::kNone || dropped[i] == pairs[i]) << i;
  }
  EXPECT_EQ(count_lost(inject(kSize, pairs, {"drop=0"})), 0);
  EXPECT_EQ(count_lost(inject(kSize, pairs, {"drop=1@5:8"})), 3);
}

TEST(InjectDrop, CountsWhatIsLost) {
  InjectedSource source(std::make_unique<test::PlainSource>(kSize, drifting_pairs(kSize, 10)),
                        kSize, {*parse_injection("drop=1@2:5")});
  EXPECT_EQ(test::play_all(source).size(), 10u);
  EXPECT_EQ(source.stats().delivered, 7);
  EXPECT_EQ(source.stats().unreadable, 3);
}

TEST(InjectDropEvery, LosesEveryNthPair) {
  const auto dropped = inject(kSize, drifting_pairs(kSize, 12), {"drop_every=4"});
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    EXPECT_EQ(dropped[i].fault != FrameFault::kNone, i % 4 == 3) << i;
  }
}

TEST(InjectFreeze, RepeatsThePairBeforeWithNewStamps) {
  const auto pairs = drifting_pairs(kSize, 8);
  const auto frozen = inject(kSize, pairs, {"freeze@3:6"});
  for (const std::size_t i : {3, 4, 5}) {
    EXPECT_EQ(frozen[i].left, pairs[2].left);
    EXPECT_EQ(frozen[i].right, pairs[2].right);
    EXPECT_EQ(frozen[i].sequence, pairs[i].sequence);
    EXPECT_EQ(frozen[i].stamp, pairs[i].stamp);
  }
  EXPECT_EQ(frozen[6], pairs[6]);
}

TEST(InjectFreeze, RepeatsTheFirstWhereThereIsNoneBefore) {
  const auto pairs = drifting_pairs(kSize, 3);
  const auto frozen = inject(kSize, pairs, {"freeze"});
  for (const auto& pair : frozen) EXPECT_EQ(pair.left, pairs[0].left);
}

TEST(InjectTear, ShowsTheLowerHalfOfTheFrameBefore) {
  const auto pairs = drifting_pairs(kSize, 6);
  const auto torn = inject(kSize, pairs, {"tear=both@2:5"});
  for (const std::size_t i : {2, 3, 4}) {
    for (const auto eye : {&PlainPair::left, &PlainPair::right}) {
      EXPECT_TRUE(has_upper_half(torn[i].*eye, pairs[i].*eye)) << i;
      EXPECT_TRUE(has_lower_half(torn[i].*eye, pairs[i - 1].*eye)) << i;
    }
  }
  EXPECT_EQ(torn[1], pairs[1]);
  EXPECT_EQ(torn[5], pairs[5]);
}

TEST(InjectTear, LeavesTheEyeThatIsNotNamed) {
  const auto pairs = drifting_pairs(kSize, 3);
  const auto left = inject(kSize, pairs, {"tear=left"});
  EXPECT_EQ(left[0], pairs[0]) << "nothing before";
  EXPECT_TRUE(has_lower_half(left[2].left, pairs[1].left));
  EXPECT_EQ(left[2].right, pairs[2].right);
  const auto right = inject(kSize, pairs, {"tear=right"});
  EXPECT_EQ(right[2].left, pairs[2].left);
  EXPECT_TRUE(has_lower_half(right[2].right, pairs[1].right));
}

TEST(InjectSkew, TakesTheRightImageOfTheFrameThen) {
  const auto pairs = drifting_pairs(kSize, 6);  // 50 ms apart
  const auto skewed = inject(kSize, pairs, {"skew_ms=100"});
  for (std::size_t i = 2; i < pairs.size(); ++i) {
    EXPECT_EQ(skewed[i].right, pairs[i - 2].right) << i;
    EXPECT_EQ(skewed[i].left, pairs[i].left);
    EXPECT_EQ(skewed[i].stamp, pairs[i].stamp);
  }
  EXPECT_EQ(skewed[0].right, pairs[0].right) << "the oldest there is";
  EXPECT_EQ(skewed[1].right, pairs[0].right);
}

TEST(InjectSkew, MixesTheTwoFramesAround) {
  const auto pairs = drifting_pairs(kSize, 4);
  const auto skewed = inject(kSize, pairs, {"skew_ms=15"});
  for (std::size_t i = 0; i < pairs[3].right.size(); ++i) {
    const double mixed = 0.7 * pairs[3].right[i] + 0.3 * pairs[2].right[i];
    EXPECT_NEAR(skewed[3].right[i], mixed, 0.51);
  }
}

TEST(InjectSkew, KnowsTheFramesBeforeItsRangeAndBridgesLosses) {
  auto pairs = drifting_pairs(kSize, 6);
  EXPECT_EQ(inject(kSize, pairs, {"skew_ms=150@5:6"})[5].right, pairs[2].right);
  pairs[4] = {.sequence = 4, .stamp = pairs[4].stamp, .fault = FrameFault::kUnpaired};
  const auto skewed = inject(kSize, pairs, {"skew_ms=50"});
  for (std::size_t i = 0; i < pairs[5].right.size(); ++i) {
    EXPECT_NEAR(skewed[5].right[i], 0.5 * (pairs[5].right[i] + pairs[3].right[i]), 0.51);
  }
}

TEST(InjectSkew, GoesBackNoFurtherThanItRemembers) {
  const auto pairs = drifting_pairs(kSize, 40);
  EXPECT_EQ(inject(kSize, pairs, {"skew_ms=500"})[39].right, pairs[29].right);
  auto fast = pairs;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    fast[i].stamp = frame_time_from_ns(5'000'000 * static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(inject(kSize, fast, {"skew_ms=500"})[39].right, fast[24].right) << "16 pairs";
}

TEST(InjectCorrupt, SpoilsOneEyeOfSomeFrames) {
  const auto pairs = drifting_pairs(kSize, 300);
  const auto corrupt = inject(kSize, pairs, {"corrupt=0.4"});
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool is_left = corrupt[i].left != pairs[i].left;
    const bool is_right = corrupt[i].right != pairs[i].right;
    EXPECT_FALSE(is_left && is_right) << i;
    left += is_left ? 1 : 0;
    right += is_right ? 1 : 0;
  }
  EXPECT_NEAR(left + right, 120, 42) << "five standard deviations";
  EXPECT_NEAR(left - right, 0, 55);
}

TEST(InjectSwap, ExchangesTheEyes) {
  const auto pairs = drifting_pairs(kSize, 3);
  const auto swapped = inject(kSize, pairs, {"swap@1:2"});
  EXPECT_EQ(swapped[1].left, pairs[1].right);
  EXPECT_EQ(swapped[1].right, pairs[1].left);
  EXPECT_EQ(swapped[2], pairs[2]);
  EXPECT_EQ(inject(kSize, pairs, {"swap", "swap"}), pairs);
}

TEST(InjectSwap, ExchangesThemForWhatComesAfter) {
  const auto pairs = drifting_pairs(kSize, 2);
  const auto covered = inject(kSize, pairs, {"swap", "cover=left"});
  EXPECT_EQ(covered[1].right, pairs[1].left);
}

TEST(InjectSameEyes, CopiesLeftToRight) {
  const auto pair = inject(kSize, drifting_pairs(kSize, 1), {"same_eyes"})[0];
  EXPECT_EQ(pair.left, drifting_pairs(kSize, 1)[0].left);
  EXPECT_EQ(pair.right, pair.left);
}

}  // namespace
}  // namespace darkling
