// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/arena.h"
#include "kernels/kernel_table.h"
#include "kernels/semi_global.h"

namespace darkling {

// Where no disparity is known.
inline constexpr float kNoDisparity = -1.0f;

// Memory of match_stereo() for one image size.
struct StereoMatcher {
  int disparities = 0;  // 0 … disparities - 1 px are searched
  PathRows paths;
  std::span<std::uint8_t> hamming_rows;     // a ring of one row a row of the window
  std::span<std::uint16_t> column_sums;     // one row: summed down the window
  std::span<std::uint8_t> cost;             // one row: summed over the window
  std::span<std::uint16_t> sum;             // one row: of the five paths
  std::span<std::uint16_t> right_best;      // one row: the right eye's lowest sum …
  std::span<std::uint8_t> right_disparity;  // … and its disparity
  ImageView<float> disparity;               // the result; px, kNoDisparity where unknown
  // Of the winning path sums: how well the eyes agree.
  double mean_cost = 0.0;
};

// The disparities searched for a thumbnail of this width: a sixth of it, in steps of 16. At 310 px
// of a car's cameras that reaches to 1.7 m, at 376 px of an 11 cm baseline to 0.4 m.
[[nodiscard]] int disparity_count(int width_px);

[[nodiscard]] StereoMatcher allocate_stereo_matcher(int width_px, int height_px, Arena& arena);

// Dense disparity of a rectified pair from its census codes: Hamming distance summed over a small
// window, semi-global aggregation, winner takes all, left-right check, equiangular sub-pixel step.
// @return the share of left pixels that got a disparity, 0…1.
double match_stereo(const KernelTable& kernels, ImageView<const std::uint8_t> left_codes,
                    ImageView<const std::uint8_t> right_codes, StereoMatcher& matcher);

// Whether the eyes are the wrong way round: matched the other way, the images agree far better.
// Says no where there is nothing to see, or all is so far away that both ways are the same.
// Leaves the matcher as match_stereo() of the eyes as given does. Cost: two match_stereo().
[[nodiscard]] bool are_eyes_swapped(const KernelTable& kernels,
                                    ImageView<const std::uint8_t> left_codes,
                                    ImageView<const std::uint8_t> right_codes,
                                    StereoMatcher& matcher);

}  // namespace darkling
