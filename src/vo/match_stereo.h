// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/arena.h"
#include "kernels/kernel_table.h"
#include "kernels/semi_global.h"

namespace darkling {

// Where no disparity is known.
inline constexpr float kNoDisparity = -1.0f;

// In bits of the window's Hamming distance (8 a pixel, 72 in all).
inline constexpr SemiGlobalPenalties kSemiGlobalPenalties = {.small_step = 8, .large_step = 32};
// Without penalties every path costs what its pixel costs, so that the winner is the least window
// sum: block matching.
inline constexpr SemiGlobalPenalties kBlockPenalties = {.small_step = 0, .large_step = 0};

// Memory of match_stereo() for one image size, and what it does there.
struct StereoMatcher {
  SemiGlobalPenalties penalties = kSemiGlobalPenalties;
  PathRows paths;
  std::uint8_t* hamming_rows = nullptr;    // a ring of three rows
  std::uint8_t* right_reversed = nullptr;  // one row of codes
  StereoRow row;
  // Of the winning path sums: how well the eyes agree.
  double mean_cost = 0.0;
};

// The pyramid level that is matched densely: the finest one at most kMaxStereoWidth wide. There 32
// disparities reach a sixth of the width and more, to 1.7 m with a car's cameras and 0.4 m with an
// 11 cm baseline, and the cost does not grow with the thumbnail. What the finer levels need is
// found from there for the points that are kept (refine_disparity.h).
[[nodiscard]] int stereo_level(int width_px, int level_count);

[[nodiscard]] StereoMatcher allocate_stereo_matcher(int width_px, Arena& arena);

// Dense disparity of a rectified pair from its census codes: Hamming distance summed over a small
// window, semi-global aggregation, winner takes all, left-right check, equiangular sub-pixel step.
// @param disparity  px of the codes' image, kNoDisparity where unknown.
// @return the share of left pixels that got a disparity, 0…1.
double match_stereo(const KernelTable& kernels, ImageView<const std::uint8_t> left_codes,
                    ImageView<const std::uint8_t> right_codes, StereoMatcher& matcher,
                    ImageView<float> disparity);

// Whether the eyes are the wrong way round: matched the other way, the images agree far better.
// Says no where there is nothing to see, or all is so far away that both ways are the same.
// Leaves what match_stereo() of the eyes as given does. Cost: two match_stereo().
[[nodiscard]] bool are_eyes_swapped(const KernelTable& kernels,
                                    ImageView<const std::uint8_t> left_codes,
                                    ImageView<const std::uint8_t> right_codes,
                                    StereoMatcher& matcher, ImageView<float> disparity);

}  // namespace darkling
