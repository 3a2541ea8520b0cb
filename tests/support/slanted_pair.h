// SPDX-License-Identifier: Apache-2.0
// A pair of eyes whose disparity is known at every pixel, and how far disparities are from it.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "support/vo_stages.h"

namespace darkling::test {

enum class Weave {
  kMixed,  // waves of 4 to 40 px, or half as long again where a coarser level is matched
  kFine,   // waves of 2.5 to 6 px, hardly more than pixels can show
  kBlobs,  // waves of 16 to 40 px
  kEdges,  // faintly shaded patches some 10 px large with sharp outlines
};

// A surface whose disparity is d0 + slope_x · x + slope_y · y at the left pixel (x, y), and what
// it looks like.
struct Surface {
  double d0_px = 6.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  Weave weave = Weave::kMixed;
  double noise_levels = 0.0;  // standard deviation of each pixel's noise, grey levels
  std::uint64_t draw = 0;     // other waves and other noise of the same kind
};

// Both eyes on a surface: right pixel (x_r, y) sees what the left one sees at
// x = (x_r + d0 + slope_y · y) / (1 - slope_x). Matched densely on `matched_level`; the image is so
// large that this level is 160 px wide.
class SlantedPair {
 public:
  explicit SlantedPair(const Surface& surface, int matched_level = 0);
  SlantedPair(double d0_px, double slope, int matched_level = 0)
      : SlantedPair(Surface{.d0_px = d0_px, .slope_x = slope}, matched_level) {}

  [[nodiscard]] double truth(int x, int y) const {
    return surface_.d0_px + surface_.slope_x * x + surface_.slope_y * y;
  }
  [[nodiscard]] double known_share() const { return known_share_; }
  // Of the matched level, in its pixels.
  [[nodiscard]] ImageView<const float> disparity() const { return disparity_; }
  [[nodiscard]] const PyramidLevel& left() const { return left_.pyramid()[0]; }
  [[nodiscard]] const PyramidLevel& right() const { return right_.pyramid()[0]; }

  // The pixel of level 0 with the disparity that its block of the matched level has.
  [[nodiscard]] PointSelector::Candidate candidate(int x, int y) const;
  // The pixels that a keyframe would choose, at most `count`.
  [[nodiscard]] std::vector<PointSelector::Candidate> points(int count) const;

 private:
  void paint_eyes();

  Surface surface_;
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
  double known_share = 0.0;  // of all that both eyes see
};

// Of points, those that both eyes see.
[[nodiscard]] DisparityError measure_disparity(const SlantedPair& pair,
                                               std::span<const PointSelector::Candidate> points);
// Of all pixels that both eyes see.
// @param disparity_at  (x, y) of level 0 → px, negative where unknown.
[[nodiscard]] DisparityError measure_disparity(const SlantedPair& pair,
                                               const std::function<double(int, int)>& disparity_at);

}  // namespace darkling::test
