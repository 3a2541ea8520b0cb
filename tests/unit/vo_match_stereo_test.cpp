// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include "support/kernel_cases.h"
#include "support/pixels.h"
#include "support/slanted_pair.h"
#include "vo/limits.h"
#include "vo/match_stereo.h"

namespace darkling {
namespace {

using test::DisparityError;
using test::measure_disparity;
using test::SlantedPair;

class EachMatchedSlant : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(EachMatchedSlant, IsFoundOnTheMatchedLevel) {
  const SlantedPair pair(GetParam().first, GetParam().second);
  EXPECT_GT(pair.known_share(), 0.8);
  const ImageView<const float> disparity = pair.disparity();
  const DisparityError matched = measure_disparity(
      pair, [&](int x, int y) { return static_cast<double>(disparity.at(x, y)); });
  RecordProperty("matched_bias_px", std::to_string(matched.bias_px));
  EXPECT_LT(matched.bad_share, 0.02);
  EXPECT_GT(matched.known_share, 0.8);
  // Below half a pixel nothing is interpolated: refinement has to find it.
  EXPECT_TRUE(GetParam().first < 0.5 || std::abs(matched.bias_px) < 0.12) << matched.bias_px;
}

INSTANTIATE_TEST_SUITE_P(Slants, EachMatchedSlant,
                         ::testing::Values(std::pair{6.0, 0.0}, std::pair{6.25, 0.0},
                                           std::pair{6.5, 0.0}, std::pair{6.75, 0.0},
                                           std::pair{0.4, 0.0}, std::pair{4.0, 0.05},
                                           std::pair{14.0, -0.05}, std::pair{3.0, 0.1},
                                           std::pair{29.0, 0.0}),
                         [](const auto& tested) { return "Case" + std::to_string(tested.index); });

// What the tests above rely on can tell a wrong disparity from a right one.
TEST(MeasuredDisparity, NoticesATenthOfAPixelAndGrossErrors) {
  const SlantedPair pair(6.25, 0.0);
  const DisparityError tenth = measure_disparity(pair, [](int, int) { return 6.35; });
  EXPECT_NEAR(tenth.bias_px, 0.1, 1e-9);
  EXPECT_EQ(tenth.known_share, 1.0);
  EXPECT_EQ(measure_disparity(pair, [](int, int) { return 8.0; }).bad_share, 1.0);
  EXPECT_EQ(measure_disparity(pair, [](int, int) { return -1.0; }).known_share, 0.0);
}

TEST(MeasuredDisparity, NoticesTheSameInPoints) {
  const SlantedPair pair(test::Surface{.d0_px = 6.25, .slope_x = 0.01, .slope_y = 0.02});
  std::vector<PointSelector::Candidate> points = pair.points(500);
  ASSERT_GT(points.size(), 300u);
  const auto measure_with_error = [&](double error_px) {
    for (PointSelector::Candidate& c : points) {
      c.disparity_px = static_cast<float>(pair.truth(c.x, c.y) + error_px);
    }
    return measure_disparity(pair, points);
  };
  EXPECT_NEAR(measure_with_error(0.1).bias_px, 0.1, 1e-5);
  EXPECT_EQ(measure_with_error(0.1).known_share, 1.0);
  EXPECT_EQ(measure_with_error(-1.5).bad_share, 1.0);
  EXPECT_EQ(measure_with_error(-100.0).known_share, 0.0);
}

// Two eyes with memory for matching them.
class MatchStereo : public ::testing::Test {
 protected:
  double match(const KernelTable& kernels = {}) {
    left_.prepare(kernels);
    right_.prepare(kernels);
    return match_stereo(kernels, left_.codes(), right_.codes(), matcher_, disparity_);
  }
  // The right eye sees noise `shift_px` further to the left; or, negative, to the right.
  void show_shifted_noise(int shift_px) {
    test::fill_image(left_.grey(), test::Fill::kUniform, 1);
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        right_.grey().at(x, y) = left_.grey().at(std::clamp(x + shift_px, 0, rig_.width - 1), y);
      }
    }
  }

  RectifiedRig rig_ = test::ideal_rig();
  test::EyeStages left_{rig_, 1};
  test::EyeStages right_{rig_, 1};
  Arena arena_{8u << 20};
  StereoMatcher matcher_ = allocate_stereo_matcher(rig_.width, arena_);
  ImageView<float> disparity_ = arena_.allocate_image<float>(rig_.width, rig_.height, "disparity");
};

TEST_F(MatchStereo, GivesTheSameDisparitiesWithEveryKernel) {
  show_shifted_noise(5);
  std::vector<float> expected;
  double expected_cost = 0.0;
  for (const KernelTable& kernels : test::available_tables()) {
    (void)match(kernels);
    const std::vector<float> disparities = test::pixels_of(disparity_);
    if (expected.empty()) {
      expected = disparities;
      expected_cost = matcher_.mean_cost;
    }
    EXPECT_EQ(disparities, expected) << kernels.name;
    EXPECT_EQ(matcher_.mean_cost, expected_cost) << kernels.name;
  }
}

// The cost of a disparity by itself: bits that differ in 3×3 codes, the nearest standing in beyond
// the border, and all of them where the other pixel is outside.
int window_cost(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int x,
                int y, int d) {
  int cost = 0;
  for (int k = 0; k < 9; ++k) {
    const int u = std::clamp(x + k % 3 - 1, 0, left.width - 1);
    const int v = std::clamp(y + k / 3 - 1, 0, left.height - 1);
    cost += u < d ? 8 : std::popcount(unsigned{left.at(u, v)} ^ unsigned{right.at(u - d, v)});
  }
  return cost;
}

TEST_F(MatchStereo, TakesTheLeastWindowCostWithoutAggregation) {
  test::fill_image(left_.grey(), test::Fill::kUniform, 1);
  test::fill_image(right_.grey(), test::Fill::kUniform, 2);
  matcher_.penalties = kBlockPenalties;
  (void)match();
  int known = 0;
  for (int y = 0; y < rig_.height; ++y) {
    for (int x = 0; x < rig_.width; ++x) {
      if (disparity_.at(x, y) == kNoDisparity) continue;
      int best = 0;
      const auto cost = [&](int d) { return window_cost(left_.codes(), right_.codes(), x, y, d); };
      for (int d = 1; d <= std::min(x, kDisparities - 1); ++d) {
        if (cost(d) < cost(best)) best = d;
      }
      ASSERT_NEAR(disparity_.at(x, y), best, 0.5) << x << " " << y;
      ++known;
    }
  }
  EXPECT_GT(known, 1000);
}

TEST_F(MatchStereo, KnowsFewerDisparitiesOfUnrelatedImages) {
  test::fill_image(left_.grey(), test::Fill::kUniform, 1);
  test::fill_image(right_.grey(), test::Fill::kUniform, 2);
  EXPECT_LT(match(), 0.7);
}

TEST_F(MatchStereo, SaysNothingOfTheLargestDisparityAsALargerOneMayBeMeant) {
  show_shifted_noise(kDisparities - 1);
  (void)match();
  int known = 0;
  for (const float d : test::pixels_of(disparity_)) known += d > 30.5f ? 1 : 0;
  EXPECT_EQ(known, 0);
}

TEST_F(MatchStereo, NoticesSwappedEyesAndOnlyThose) {
  show_shifted_noise(9);
  left_.prepare(KernelTable());
  right_.prepare(KernelTable());
  EXPECT_FALSE(
      are_eyes_swapped(KernelTable(), left_.codes(), right_.codes(), matcher_, disparity_));
  EXPECT_TRUE(are_eyes_swapped(KernelTable(), right_.codes(), left_.codes(), matcher_, disparity_));
}

TEST(StereoLevel, IsTheFinestAtMostKMaxStereoWidthWide) {
  EXPECT_EQ(stereo_level(160, 3), 0);
  EXPECT_EQ(stereo_level(192, 3), 0);
  EXPECT_EQ(stereo_level(193, 3), 1);
  EXPECT_EQ(stereo_level(310, 4), 1);
  EXPECT_EQ(stereo_level(385, 4), 1);  // halved: 192, the odd column left out
  EXPECT_EQ(stereo_level(386, 4), 2);
  for (int width = kMinWidth; width <= kMaxWidth; ++width) {
    const int level = stereo_level(width, kMaxLevels);
    EXPECT_LE(width >> level, kMaxStereoWidth);
    EXPECT_TRUE(level == 0 || (width >> (level - 1)) > kMaxStereoWidth) << width;
  }
}

TEST(StereoLevel, StaysWithinThePyramid) {
  EXPECT_EQ(stereo_level(1280, 1), 0);
  EXPECT_EQ(stereo_level(1280, 2), 1);
  EXPECT_EQ(stereo_level(64, 1), 0);
}

}  // namespace
}  // namespace darkling
