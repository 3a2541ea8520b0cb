// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "support/kernel_cases.h"
#include "support/pixels.h"
#include "support/vo_stages.h"
#include "vo/match_stereo.h"
#include "vo/refine_disparity.h"

namespace darkling {
namespace {

// Both eyes on a texture whose disparity is d0 + slope · x at the left pixel x: right pixel x_r
// sees what the left one sees at (x_r + d0) / (1 - slope).
class SlantedPair {
 public:
  SlantedPair(double d0_px, double slope) : d0_px_(d0_px), slope_(slope) {
    const test::SmoothTexture texture({.min_length = 4.0, .max_length = 40.0, .seed = 17});
    test::paint(left_.grey(), [&](int x, int y) { return texture.mean(x, y, 1.0); });
    test::paint(right_.grey(),
                [&](int x, int y) { return texture.mean((x + d0_px) / (1.0 - slope), y, 1.0); });
    left_.prepare(kernels_);
    right_.prepare(kernels_);
    known_share_ = match_stereo(kernels_, left_.codes(), right_.codes(), matcher_);
  }

  [[nodiscard]] double truth(int x) const { return d0_px_ + slope_ * x; }
  [[nodiscard]] double known_share() const { return known_share_; }
  [[nodiscard]] ImageView<const float> disparity() const { return matcher_.disparity; }
  [[nodiscard]] const PyramidLevel& left() const { return left_.pyramid()[0]; }
  [[nodiscard]] const PyramidLevel& right() const { return right_.pyramid()[0]; }

 private:
  double d0_px_;
  double slope_;
  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::EyeStages left_{rig_, 1};
  test::EyeStages right_{rig_, 1};
  Arena arena_{8u << 20};
  StereoMatcher matcher_ = allocate_stereo_matcher(rig_.width, rig_.height, arena_);
  double known_share_ = 0.0;
};

struct DisparityError {
  double bias_px = 0.0;    // mean of the errors under a pixel
  double spread_px = 0.0;  // their standard deviation
  double bad_share = 1.0;  // of the known: wrong by a pixel or more
  int count = 0;
};

// @param disparity_at  (x, y) → px, kNoDisparity where unknown.
template <class DisparityAt>
DisparityError measure(const SlantedPair& pair, const DisparityAt& disparity_at) {
  DisparityError error;
  double sum = 0.0;
  double squares = 0.0;
  int bad = 0;
  for (int y = 8; y < 112; ++y) {
    for (int x = 32; x < 150; ++x) {  // where the right eye sees it too
      const double d = disparity_at(x, y);
      if (d < 0.0) continue;
      ++error.count;
      const double e = d - pair.truth(x);
      if (std::abs(e) >= 1.0) {
        ++bad;
        continue;
      }
      sum += e;
      squares += e * e;
    }
  }
  const int good = std::max(error.count - bad, 1);
  error.bias_px = sum / good;
  error.spread_px = std::sqrt(std::max(squares / good - error.bias_px * error.bias_px, 0.0));
  error.bad_share = static_cast<double>(bad) / std::max(error.count, 1);
  return error;
}

DisparityError measure_refined(const SlantedPair& pair) {
  const ImageView<const float> disparity = pair.disparity();
  return measure(pair, [&](int x, int y) -> double {
    if (disparity.at(x, y) < 0.0f) return -1.0;
    PointSelector::Candidate candidate = {static_cast<std::uint16_t>(x),
                                          static_cast<std::uint16_t>(y), 0, disparity.at(x, y)};
    refine_disparities(pair.left(), pair.right(), {&candidate, 1});
    return static_cast<double>(candidate.disparity_px);
  });
}

class EachSlant : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(EachSlant, IsFoundWithoutBias) {
  const SlantedPair pair(GetParam().first, GetParam().second);
  EXPECT_GT(pair.known_share(), 0.8);
  const ImageView<const float> disparity = pair.disparity();
  const DisparityError matched =
      measure(pair, [&](int x, int y) { return static_cast<double>(disparity.at(x, y)); });
  const DisparityError refined = measure_refined(pair);
  RecordProperty("matched_bias_px", std::to_string(matched.bias_px));
  RecordProperty("refined_bias_px", std::to_string(refined.bias_px));
  RecordProperty("refined_spread_px", std::to_string(refined.spread_px));
  EXPECT_LT(matched.bad_share, 0.02);
  EXPECT_LT(refined.bad_share, 0.01);
  EXPECT_GT(refined.count, 118 * 104 * 8 / 10);
  // Below half a pixel nothing is interpolated: refinement has to find it.
  EXPECT_TRUE(GetParam().first < 0.5 || std::abs(matched.bias_px) < 0.12) << matched.bias_px;
  EXPECT_LT(std::abs(refined.bias_px), 0.05);
  EXPECT_LT(refined.spread_px, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Slants, EachSlant,
                         ::testing::Values(std::pair{6.0, 0.0}, std::pair{6.25, 0.0},
                                           std::pair{6.5, 0.0}, std::pair{6.75, 0.0},
                                           std::pair{0.4, 0.0}, std::pair{4.0, 0.05},
                                           std::pair{14.0, -0.05}, std::pair{3.0, 0.1}),
                         [](const auto& tested) { return "Case" + std::to_string(tested.index); });

// What the test above relies on can tell a wrong disparity from a right one.
TEST(MeasuredDisparity, NoticesATenthOfAPixelAndGrossErrors) {
  const SlantedPair pair(6.25, 0.0);
  EXPECT_NEAR(measure(pair, [](int, int) { return 6.35; }).bias_px, 0.1, 1e-9);
  EXPECT_EQ(measure(pair, [](int, int) { return 8.0; }).bad_share, 1.0);
  EXPECT_EQ(measure(pair, [](int, int) { return -1.0; }).count, 0);
}

TEST(MatchStereo, GivesTheSameDisparitiesWithEveryKernel) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages left(rig, 1);
  test::EyeStages right(rig, 1);
  test::fill_image(left.grey(), test::Fill::kUniform, 1);
  for (int y = 0; y < rig.height; ++y) {
    for (int x = 0; x < rig.width; ++x) {
      right.grey().at(x, y) = left.grey().at(std::min(x + 5, rig.width - 1), y);
    }
  }
  std::vector<float> expected;
  for (const KernelTable& kernels : test::available_tables()) {
    left.prepare(kernels);
    right.prepare(kernels);
    Arena arena(8u << 20);
    StereoMatcher matcher = allocate_stereo_matcher(rig.width, rig.height, arena);
    (void)match_stereo(kernels, left.codes(), right.codes(), matcher);
    const std::vector<float> disparities = test::pixels_of(matcher.disparity);
    if (expected.empty()) expected = disparities;
    EXPECT_EQ(disparities, expected) << kernels.name;
  }
}

TEST(MatchStereo, KnowsFewerDisparitiesOfUnrelatedImages) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages left(rig, 1);
  test::EyeStages right(rig, 1);
  test::fill_image(left.grey(), test::Fill::kUniform, 1);
  test::fill_image(right.grey(), test::Fill::kUniform, 2);
  left.prepare(KernelTable());
  right.prepare(KernelTable());
  Arena arena(8u << 20);
  StereoMatcher matcher = allocate_stereo_matcher(rig.width, rig.height, arena);
  EXPECT_LT(match_stereo(KernelTable(), left.codes(), right.codes(), matcher), 0.7);
}

TEST(DisparityCount, IsASixthOfTheWidthInStepsOf16) {
  EXPECT_EQ(disparity_count(64), 16);
  EXPECT_EQ(disparity_count(160), 32);
  EXPECT_EQ(disparity_count(310), 64);
  EXPECT_EQ(disparity_count(kMaxWidth), 224);
  for (int width = kMinWidth; width <= kMaxWidth; ++width) {
    EXPECT_EQ(disparity_count(width) % 16, 0);
    EXPECT_LE(disparity_count(width), kMaxDisparities);
  }
}

TEST(RefineDisparities, GivesUpNearTheBorderAndOnFlatPatches) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages flat(rig, 1);
  test::fill_image(flat.grey(), test::Fill::kConstant, 100);
  flat.prepare(KernelTable());
  const SlantedPair pair(6.0, 0.0);
  PointSelector::Candidate middle = {80, 60, 0, 6.0f};
  refine_disparities(flat.pyramid()[0], flat.pyramid()[0], {&middle, 1});
  EXPECT_EQ(middle.disparity_px, kNoDisparity);
  for (PointSelector::Candidate c : {PointSelector::Candidate{0, 60, 0, 0.0f},
                                     {159, 60, 0, 6.0f},
                                     {80, 0, 0, 6.0f},
                                     {80, 119, 0, 6.0f},
                                     {5, 60, 0, 6.0f}}) {
    refine_disparities(pair.left(), pair.right(), {&c, 1});
    EXPECT_EQ(c.disparity_px, kNoDisparity) << c.x << " " << c.y;
  }
}

TEST(RefineDisparities, GivesUpOnADisparityTwoPixelsOff) {
  const SlantedPair pair(6.0, 0.0);
  int kept = 0;
  for (int x = 40; x < 140; ++x) {
    PointSelector::Candidate c = {static_cast<std::uint16_t>(x), 60, 0, 8.0f};
    refine_disparities(pair.left(), pair.right(), {&c, 1});
    kept += c.disparity_px >= 0.0f && std::abs(c.disparity_px - 6.0f) > 1.0f ? 1 : 0;
  }
  EXPECT_LT(kept, 50);
}

TEST(RefineDisparities, GivesUpWhereTheEyesSeeDifferentThings) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages other(rig, 1);
  const SlantedPair pair(6.0, 0.0);
  for (const test::Fill fill : {test::Fill::kUniform, test::Fill::kConstant}) {
    test::fill_image(other.grey(), fill, 5);
    other.prepare(KernelTable());
    int kept = 0;
    for (int x = 40; x < 140; ++x) {
      PointSelector::Candidate c = {static_cast<std::uint16_t>(x), 60, 0, 6.0f};
      refine_disparities(pair.left(), other.pyramid()[0], {&c, 1});
      kept += c.disparity_px >= 0.0f ? 1 : 0;
    }
    EXPECT_LT(kept, 50) << test::name_of(fill);  // noise looks like anything, half of the time
  }
}

TEST(DropUnknown, KeepsTheKnownInTheirOrder) {
  PointSelector::Candidate candidates[] = {
      {1, 0, 0, 1.0f}, {2, 0, 0, kNoDisparity}, {3, 0, 0, 0.0f}, {4, 0, 0, kNoDisparity}};
  const auto known = drop_unknown(candidates);
  ASSERT_EQ(known.size(), 2u);
  EXPECT_EQ(known[0].x, 1);
  EXPECT_EQ(known[1].x, 3);
}

}  // namespace
}  // namespace darkling
