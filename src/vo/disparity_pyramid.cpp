// SPDX-License-Identifier: Apache-2.0
#include "vo/disparity_pyramid.h"

#include <algorithm>
#include <cstdint>

#include "base/check.h"
#include "vo/match_stereo.h"

namespace darkling {

namespace {

void order(float& low, float& high) {
  const float a = low;
  const float b = high;
  low = a < b ? a : b;
  high = a < b ? b : a;
}

// The median of those of four disparities that are known; of an even number the mean of the two in
// the middle. Free of branches: which are known is as good as random.
float known_median(float a, float b, float c, float d) {
  order(a, b);
  order(c, d);
  order(a, c);
  order(b, d);
  order(b, c);
  const float sorted[4] = {a, b, c, d};  // the unknown ones first
  const int known = (a >= 0.0f) + (b >= 0.0f) + (c >= 0.0f) + (d >= 0.0f);
  constexpr std::uint8_t kLower[5] = {3, 3, 2, 2, 1};  // of no known ones, an unknown one
  constexpr std::uint8_t kUpper[5] = {3, 3, 3, 2, 2};
  return 0.5f * (sorted[kLower[known]] + sorted[kUpper[known]]);
}

void reduce_level(ImageView<const float> fine, ImageView<float> coarse) {
  for (int y = 0; y < coarse.height; ++y) {
    const float* upper = fine.row(2 * y);
    const float* lower = fine.row(2 * y + 1);
    float* __restrict out = coarse.row(y);
    for (int x = 0; x < coarse.width; ++x) {
      const float median =
          known_median(upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]);
      out[x] = median < 0.0f ? kNoDisparity : 0.5f * median;
    }
  }
}

}  // namespace

DisparityPyramid::At DisparityPyramid::at_level(int level) const {
  const int above = level - dense_level;
  return {levels[static_cast<std::size_t>(std::max(above, 0))], std::max(-above, 0)};
}

DisparityPyramid allocate_disparities(int width_px, int height_px, int level_count, int dense_level,
                                      Arena& arena) {
  DisparityPyramid pyramid;
  pyramid.dense_level = dense_level;
  for (int l = dense_level; l < level_count; ++l) {
    CHECK(pyramid.levels.push_back(
              arena.allocate_image<float>(width_px >> l, height_px >> l, "disparities")),
          "more levels than kMaxLevels");
  }
  return pyramid;
}

void reduce_disparities(DisparityPyramid& pyramid) {
  for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
    reduce_level(pyramid.levels[l - 1], pyramid.levels[l]);
  }
}

}  // namespace darkling
