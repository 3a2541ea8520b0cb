// SPDX-License-Identifier: Apache-2.0
// A pair of eyes whose disparity is known at every pixel, and how far disparities are from it.
#pragma once

#include <functional>

#include "support/vo_stages.h"

namespace darkling::test {

// Both eyes on a texture whose disparity is d0 + slope · x at the left pixel x: right pixel x_r
// sees what the left one sees at (x_r + d0) / (1 - slope). Matched densely on `matched_level`; the
// image is so large that this level is 160 px wide.
class SlantedPair {
 public:
  SlantedPair(double d0_px, double slope, int matched_level = 0);

  [[nodiscard]] double truth(int x) const { return d0_px_ + slope_ * x; }
  [[nodiscard]] double known_share() const { return known_share_; }
  // Of the matched level, in its pixels.
  [[nodiscard]] ImageView<const float> disparity() const { return disparity_; }
  [[nodiscard]] const PyramidLevel& left() const { return left_.pyramid()[0]; }
  [[nodiscard]] const PyramidLevel& right() const { return right_.pyramid()[0]; }

  // The pixel of level 0 with the disparity that its block of the matched level has.
  [[nodiscard]] PointSelector::Candidate candidate(int x, int y) const;

 private:
  double d0_px_;
  double slope_;
  int matched_level_;
  RectifiedRig rig_;
  KernelTable kernels_;
  EyeStages left_;
  EyeStages right_;
  Arena arena_{8u << 20};
  StereoMatcher matcher_;
  ImageView<float> disparity_;
  double known_share_ = 0.0;
};

struct DisparityError {
  double bias_px = 0.0;      // mean of the errors under a pixel
  double spread_px = 0.0;    // their standard deviation
  double bad_share = 1.0;    // of the known: wrong by a pixel or more
  double known_share = 0.0;  // of all pixels that both eyes see
};

// @param disparity_at  (x, y) of level 0 → px, negative where unknown.
[[nodiscard]] DisparityError measure_disparity(const SlantedPair& pair,
                                               const std::function<double(int, int)>& disparity_at);

}  // namespace darkling::test
