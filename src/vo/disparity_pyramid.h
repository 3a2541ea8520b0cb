// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/arena.h"
#include "base/fixed_vector.h"
#include "vo/limits.h"

namespace darkling {

// Disparities of the pyramid levels from the densely matched one up, each in its own pixels.
struct DisparityPyramid {
  int dense_level = 0;
  FixedVector<ImageView<float>, kMaxLevels> levels;  // of dense_level, dense_level + 1, …

  // What is known about level `level`: its own disparities, or below the dense level those of the
  // coarser pixels that its pixels became part of.
  struct At {
    ImageView<const float> disparity;
    int halvings = 0;  // from the level's pixels to those of `disparity`
    // px of the level, kNoDisparity where unknown.
    [[nodiscard]] float operator()(int x, int y) const {
      return disparity.at(x >> halvings, y >> halvings) * static_cast<float>(1 << halvings);
    }
  };
  [[nodiscard]] At at_level(int level) const;
};

// @param width_px, height_px  of level 0.
[[nodiscard]] DisparityPyramid allocate_disparities(int width_px, int height_px, int level_count,
                                                    int dense_level, Arena& arena);

// Fills the levels above the dense one: the median of what is known of each 2×2 block (of an even
// number the mean of the middle two), in the pixels of the coarser level.
void reduce_disparities(DisparityPyramid& pyramid);

}  // namespace darkling
