// SPDX-License-Identifier: Apache-2.0
// Template points and their residuals between guard pages: each array as long as the kernels are
// promised, and not an element more.
#pragma once

#include <algorithm>

#include "kernels/sample_residuals.h"
#include "support/guarded_image.h"

namespace darkling::test {

// An array for `count` points; of none, a single element that nobody may need.
[[nodiscard]] inline GuardedLayout lanes_layout(int count) {
  return {.width = std::max(round_up_to_lanes(count), 1), .height = 1};
}

class GuardedPoints {
 public:
  explicit GuardedPoints(int count) : GuardedPoints(count, lanes_layout(count)) {}

  [[nodiscard]] const TemplatePoints& points() const { return points_; }
  [[nodiscard]] TemplatePoints& points() { return points_; }
  [[nodiscard]] bool padding_is_untouched() const {
    return x_.padding_is_untouched() && y_.padding_is_untouched() &&
           inverse_depth_focal_.padding_is_untouched() && Sxx_.padding_is_untouched() &&
           Sxy_.padding_is_untouched() && Syy_.padding_is_untouched() &&
           patches_.padding_is_untouched();
  }

 private:
  GuardedPoints(int count, const GuardedLayout& layout)
      : x_(layout),
        y_(layout),
        inverse_depth_focal_(layout),
        Sxx_(layout),
        Sxy_(layout),
        Syy_(layout),
        patches_(layout) {
    points_ = {count,
               x_.view().data,
               y_.view().data,
               inverse_depth_focal_.view().data,
               Sxx_.view().data,
               Sxy_.view().data,
               Syy_.view().data,
               patches_.view().data};
  }

  GuardedImage<float> x_;
  GuardedImage<float> y_;
  GuardedImage<float> inverse_depth_focal_;
  GuardedImage<float> Sxx_;
  GuardedImage<float> Sxy_;
  GuardedImage<float> Syy_;
  GuardedImage<PlanePatch> patches_;
  TemplatePoints points_;
};

class GuardedResiduals {
 public:
  explicit GuardedResiduals(int count)
      : bx_(lanes_layout(count)), by_(lanes_layout(count)), squares_(lanes_layout(count)) {}

  [[nodiscard]] PointResiduals out() {
    return {bx_.view().data, by_.view().data, squares_.view().data};
  }
  [[nodiscard]] bool padding_is_untouched() const {
    return bx_.padding_is_untouched() && by_.padding_is_untouched() &&
           squares_.padding_is_untouched();
  }

 private:
  GuardedImage<float> bx_;
  GuardedImage<float> by_;
  GuardedImage<float> squares_;
};

}  // namespace darkling::test
