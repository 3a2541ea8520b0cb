// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "support/plain_source.h"

namespace darkling {
namespace {

using test::drifting_pairs;
using test::flat_pairs;
using test::inject;
using test::PlainPair;

constexpr ImageSize kSize{.width = 121, .height = 81};
constexpr int kMiddle = 40 * 121 + 60;

// Black, and white at one pixel of both eyes.
PlainPair dot_pair(std::int64_t sequence, int at) {
  PlainPair pair = flat_pairs(kSize, 1, 0)[0];
  pair.sequence = sequence;
  pair.left[static_cast<std::size_t>(at)] = 250;
  pair.right[static_cast<std::size_t>(at)] = 250;
  return pair;
}

TEST(InjectBlur, SmearsADotOverSoManyPixelsInARow) {
  const auto pair = inject(kSize, {dot_pair(0, kMiddle)}, {"blur_px=5"})[0];
  for (int x = 0; x < kSize.width; ++x) {
    const std::size_t i = static_cast<std::size_t>(40 * kSize.width + x);
    EXPECT_EQ(pair.left[i], std::abs(x - 60) <= 2 ? 50 : 0) << x;
  }
  EXPECT_EQ(pair.left, pair.right);
}

TEST(InjectBlur, TurnsItsDirectionSlowly) {
  const auto upright = inject(kSize, {dot_pair(60, kMiddle)}, {"blur_px=5"})[0];
  for (int y = 0; y < kSize.height; ++y) {
    const std::size_t i = static_cast<std::size_t>(y * kSize.width + 60);
    EXPECT_EQ(upright.left[i], std::abs(y - 40) <= 2 ? 50 : 0) << y;
  }
  const auto slanted = inject(kSize, {dot_pair(30, kMiddle)}, {"blur_px=5"})[0];
  EXPECT_GT(slanted.left[kMiddle + 121 + 1], 0) << "to the right and down";
  EXPECT_EQ(slanted.left[kMiddle + 121 - 1], 0);
}

TEST(InjectBlur, KeepsAFlatPictureUpToItsEdges) {
  for (const char* injection : {"blur_px=2", "blur_px=7", "blur_px=64"}) {
    const auto flat = flat_pairs(kSize, 130, 255);
    EXPECT_EQ(inject(kSize, flat, {injection}), flat) << injection;
  }
}

TEST(InjectRollRight, TurnsTheRightEyeAboutItsMiddleOnly) {
  // 50 px to the right of the middle; the camera turns towards y, so what it sees turns upwards.
  const PlainPair clean = dot_pair(0, kMiddle + 50);
  const auto pair = inject(kSize, {clean}, {"roll_right_deg=5"})[0];
  EXPECT_EQ(pair.left, clean.left);
  const auto peak = std::max_element(pair.right.begin(), pair.right.end()) - pair.right.begin();
  EXPECT_NEAR(static_cast<double>(peak % 121), 60.0 + 50.0 * std::cos(5.0 / 57.3), 0.8);
  EXPECT_NEAR(static_cast<double>(peak / 121), 40.0 - 50.0 * std::sin(5.0 / 57.3), 0.8);
}

TEST(InjectRollRight, LeavesAllAsItIsAtNoAngle) {
  const auto clean = drifting_pairs(kSize, 1);
  EXPECT_EQ(inject(kSize, clean, {"roll_right_deg=0"}), clean);
}

// How many pixels of a pair at level 0 and 255 by turns were painted over; where the first is.
struct Painted {
  int count = 0;
  int first_column = -1;
  int last_column = -1;
};

Painted find_board(const std::vector<std::uint8_t>& before,
                   const std::vector<std::uint8_t>& after) {
  Painted painted;
  for (int x = 0; x < kSize.width; ++x) {
    int in_column = 0;
    for (int y = 0; y < kSize.height; ++y) {
      const std::size_t i = static_cast<std::size_t>(y * kSize.width + x);
      in_column += before[i] != after[i] ? 1 : 0;
    }
    painted.count += in_column;
    if (in_column > 0 && painted.first_column < 0) painted.first_column = x;
    if (in_column > 0) painted.last_column = x;
  }
  return painted;
}

PlainPair chequered_pair(std::int64_t sequence) {
  PlainPair pair = flat_pairs(kSize, 1, 0)[0];
  pair.sequence = sequence;
  for (std::size_t i = 0; i < pair.left.size(); i += 2) pair.left[i] = 255;
  pair.right = pair.left;
  return pair;
}

TEST(InjectOcclude, CoversItsShareWithABoardThatBothEyesSeeNearby) {
  for (std::int64_t sequence = 0; sequence < 70; sequence += 7) {
    const PlainPair clean = chequered_pair(sequence);
    const auto pair = inject(kSize, {clean}, {"occlude=0.25"})[0];
    const Painted left = find_board(clean.left, pair.left);
    const Painted right = find_board(clean.right, pair.right);
    EXPECT_NEAR(left.count / (121.0 * 81.0), 0.25, 0.02) << sequence;
    EXPECT_EQ(left.last_column - right.last_column, 121 / 12) << sequence;
  }
}

TEST(InjectOcclude, HasTheSameTextureInBothEyes) {
  const auto pair = inject(kSize, {chequered_pair(5)}, {"occlude=0.25"})[0];
  const Painted left = find_board(chequered_pair(5).left, pair.left);
  const int middle = (left.first_column + left.last_column) / 2;
  int compared = 0;
  for (std::size_t y = 0; y < 81; ++y) {
    const std::size_t i = y * 121 + static_cast<std::size_t>(middle);
    if (pair.left[i] == 0 || pair.left[i] == 255) continue;
    EXPECT_EQ(pair.left[i], pair.right[i - 10]) << y;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(InjectOcclude, StaysInsideOfTheLeftEyeWhateverItsSize) {
  for (const char* injection : {"occlude=0.01", "occlude=0.9", "occlude=0.5,seed=4"}) {
    for (std::int64_t sequence = 0; sequence < 200; ++sequence) {
      const auto pair = inject(kSize, {chequered_pair(sequence)}, {injection})[0];
      EXPECT_NE(pair.left, chequered_pair(sequence).left);
    }
  }
}

}  // namespace
}  // namespace darkling
