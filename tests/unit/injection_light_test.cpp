// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "support/plain_source.h"

namespace darkling {
namespace {

using test::drifting_pairs;
using test::flat_pairs;
using test::inject;

constexpr ImageSize kSize{.width = 120, .height = 80};

// The level that one of `level` becomes, checked to be the same all over both eyes.
int level_after(std::uint8_t level, const std::string& injection) {
  const auto pair = inject(kSize, flat_pairs(kSize, 1, level), {injection})[0];
  const auto [low, high] = std::minmax_element(pair.left.begin(), pair.left.end());
  EXPECT_EQ(*low, *high);
  EXPECT_EQ(pair.left, pair.right);
  return *low;
}

double mean_of(const std::vector<std::uint8_t>& levels) {
  return std::accumulate(levels.begin(), levels.end(), 0.0) / static_cast<double>(levels.size());
}

TEST(InjectGain, MultipliesRoundsAndClips) {
  EXPECT_EQ(level_after(100, "gain=1"), 100);
  EXPECT_EQ(level_after(101, "gain=0.5"), 51);
  EXPECT_EQ(level_after(100, "gain=2.5"), 250);
  EXPECT_EQ(level_after(100, "gain=3"), 255);
  EXPECT_EQ(level_after(0, "gain=100"), 0);
}

TEST(InjectGamma, KeepsBlackAndWhiteAndBendsWhatIsBetween) {
  EXPECT_EQ(level_after(0, "gamma=2"), 0);
  EXPECT_EQ(level_after(255, "gamma=2"), 255);
  EXPECT_EQ(level_after(128, "gamma=2"), 64);
  EXPECT_EQ(level_after(64, "gamma=0.5"), 128);
  EXPECT_EQ(level_after(77, "gamma=1"), 77);
}

TEST(InjectFlicker, IsBrighterOrDarkerByItsShareAlikeInBothEyes) {
  const auto pairs = inject(kSize, flat_pairs(kSize, 200, 100), {"flicker=0.2"});
  int bright = 0;
  for (const auto& pair : pairs) {
    EXPECT_TRUE(pair.left[0] == 80 || pair.left[0] == 120) << int{pair.left[0]};
    EXPECT_EQ(pair.left, pair.right);
    bright += pair.left[0] == 120 ? 1 : 0;
  }
  EXPECT_NEAR(bright, 100, 35) << "five standard deviations of a coin";
}

TEST(InjectSaturate, ClipsTheShareThatWasAskedFor) {
  const auto clean = drifting_pairs(kSize, 1);
  for (const double share : {0.05, 0.3, 0.9}) {
    const auto pair = inject(kSize, clean, {"saturate=" + std::to_string(share)})[0];
    const auto white = std::count(pair.left.begin(), pair.left.end(), 255) +
                       std::count(pair.right.begin(), pair.right.end(), 255);
    EXPECT_NEAR(static_cast<double>(white) / (2.0 * 120 * 80), share, 0.02);
  }
}

TEST(InjectSaturate, MakesWhiteOfOneLevelAndNothingOfBlack) {
  EXPECT_EQ(level_after(10, "saturate=0.01"), 255);
  EXPECT_EQ(level_after(0, "saturate=0.5"), 0);
}

TEST(InjectLamp, IsASpotThatWandersInTheSamePlaceOfBothEyes) {
  const auto pairs = inject(kSize, flat_pairs(kSize, 70, 20), {"lamp=4"});
  std::vector<std::ptrdiff_t> columns;
  for (const auto& pair : pairs) {
    EXPECT_EQ(pair.left, pair.right);
    const auto peak = std::max_element(pair.left.begin(), pair.left.end());
    EXPECT_NEAR(*peak, 100, 2) << "five times as bright";
    EXPECT_EQ(*std::min_element(pair.left.begin(), pair.left.end()), 20);
    columns.push_back((peak - pair.left.begin()) % kSize.width);
  }
  const auto [low, high] = std::minmax_element(columns.begin(), columns.end());
  EXPECT_LT(*low, 20);
  EXPECT_GT(*high, 100);
  for (std::size_t i = 1; i < columns.size(); ++i) {
    EXPECT_LE(std::abs(columns[i] - columns[i - 1]), 8) << "it does not jump";
  }
  EXPECT_NE(pairs[0].left, inject(kSize, flat_pairs(kSize, 1, 20), {"lamp=4,seed=2"})[0].left);
}

TEST(InjectVignette, DarkensCornersByItsShareAndLeavesTheMiddle) {
  const auto pair = inject(kSize, flat_pairs(kSize, 1, 200), {"vignette=0.5"})[0];
  EXPECT_NEAR(pair.left[0], 100, 3);
  EXPECT_EQ(pair.left[0], pair.left[119]);
  EXPECT_EQ(pair.left[0], pair.left.back());
  EXPECT_EQ(pair.left[40 * 120 + 60], 200);
  EXPECT_EQ(pair.left, pair.right);
}

TEST(InjectBlackout, LeavesTheBlackLevelAndALittleNoise) {
  const auto pairs = inject(kSize, drifting_pairs(kSize, 3), {"blackout@1:2"});
  EXPECT_EQ(pairs[0], drifting_pairs(kSize, 3)[0]);
  EXPECT_EQ(pairs[2], drifting_pairs(kSize, 3)[2]);
  EXPECT_NEAR(mean_of(pairs[1].left), 3.0, 0.05);
  EXPECT_LE(*std::max_element(pairs[1].left.begin(), pairs[1].left.end()), 7);
  EXPECT_NE(pairs[1].left, pairs[1].right);
}

TEST(InjectCover, LeavesTheOtherEye) {
  const auto clean = drifting_pairs(kSize, 1);
  const auto left = inject(kSize, clean, {"cover=left"})[0];
  EXPECT_NEAR(mean_of(left.left), 3.0, 0.05);
  EXPECT_EQ(left.right, clean[0].right);
  const auto right = inject(kSize, clean, {"cover=right"})[0];
  EXPECT_EQ(right.left, clean[0].left);
  EXPECT_NEAR(mean_of(right.right), 3.0, 0.05);
}

TEST(InjectOneLevel, FillsBothEyes) {
  EXPECT_EQ(level_after(9, "black"), 0);
  EXPECT_EQ(level_after(9, "white"), 255);
  EXPECT_EQ(level_after(9, "constant=128"), 128);
}

TEST(InjectNoise, HasEveryLevelAsOftenAndNothingInCommon) {
  const auto pairs = inject(kSize, drifting_pairs(kSize, 2), {"noise"});
  EXPECT_NEAR(mean_of(pairs[0].left), 127.5, 5.0 * 73.9 / std::sqrt(9600.0));
  EXPECT_EQ(*std::min_element(pairs[0].left.begin(), pairs[0].left.end()), 0);
  EXPECT_EQ(*std::max_element(pairs[0].left.begin(), pairs[0].left.end()), 255);
  EXPECT_NE(pairs[0].left, pairs[0].right);
  EXPECT_NE(pairs[0].left, pairs[1].left);
}

}  // namespace
}  // namespace darkling
