// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "vo/disparity_pyramid.h"
#include "vo/match_stereo.h"

namespace darkling {
namespace {

// Two levels of disparities over an image of 2×2 pixels.
class ReduceDisparities : public ::testing::Test {
 protected:
  float reduce(const std::array<float, 4>& block) {
    for (int i = 0; i < 4; ++i) pyramid_.levels[0].at(i % 2, i / 2) = block[i];
    reduce_disparities(pyramid_);
    return pyramid_.levels[1].at(0, 0);
  }

  Arena arena_{1u << 16};
  DisparityPyramid pyramid_ = allocate_disparities(2, 2, 2, 0, arena_);
};

// The median of what is known, of an even number the mean of the middle two, by sorting.
float median_oracle(const std::array<float, 4>& block) {
  std::vector<float> known;
  std::copy_if(block.begin(), block.end(), std::back_inserter(known),
               [](float d) { return d >= 0.0f; });
  if (known.empty()) return kNoDisparity;
  std::sort(known.begin(), known.end());
  const std::size_t n = known.size();
  return 0.5f * (known[(n - 1) / 2] + known[n / 2]);
}

TEST_F(ReduceDisparities, TakeTheMedianOfWhatIsKnownInCoarsePixels) {
  const float values[] = {kNoDisparity, 0.0f, 1.0f, 2.5f, 7.0f};
  for (int i = 0; i < 5 * 5 * 5 * 5; ++i) {
    const std::array<float, 4> block = {values[i % 5], values[i / 5 % 5], values[i / 25 % 5],
                                        values[i / 125]};
    const float median = median_oracle(block);
    ASSERT_EQ(reduce(block), median < 0.0f ? kNoDisparity : 0.5f * median) << i;
  }
}

TEST(DisparityPyramid, AnswersForEveryLevelInItsOwnPixels) {
  Arena arena(1u << 16);
  DisparityPyramid pyramid = allocate_disparities(8, 8, 3, 1, arena);
  ASSERT_EQ(pyramid.levels.size(), 2u);
  for (int i = 0; i < 16; ++i) pyramid.levels[0].at(i % 4, i / 4) = static_cast<float>(i / 4);
  pyramid.levels[0].at(3, 3) = kNoDisparity;
  reduce_disparities(pyramid);
  EXPECT_EQ(pyramid.at_level(0)(5, 4), 4.0f);  // the pixel (2, 2) of level 1, whose 2 are 4 here
  EXPECT_LT(pyramid.at_level(0)(7, 7), 0.0f);
  EXPECT_EQ(pyramid.at_level(1)(2, 3), 3.0f);
  EXPECT_EQ(pyramid.at_level(2)(0, 0), 0.25f);
}

}  // namespace
}  // namespace darkling
