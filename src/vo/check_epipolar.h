// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/arena.h"
#include "base/result.h"
#include "base/stereo_frame.h"
#include "geometry/stereo_rig.h"
#include "kernels/kernel_table.h"
#include "kernels/remap_area.h"
#include "vo/frame_pyramid.h"

namespace darkling {

// A calibration that fits its cameras puts what the left eye sees at (u, v) into the same row of
// the right one. A median |v_right - v_left| of this much, in px of the thumbnail, is wrong: stereo
// looks in the same row only.
inline constexpr double kMostEpipolarOffset_px = 1.0;
// Fewer matches than this say nothing.
inline constexpr int kFewestEpipolarMatches = 30;

// How far the rows of a rectified pair are apart, and what that looks like.
struct EpipolarReport {
  int corners = 0;             // of the left eye that were looked for
  int matches = 0;             // that were found in the right eye, once and clearly
  double median_abs_px = 0.0;  // of |v_right - v_left|; the rest needs kFewestEpipolarMatches, too
  double median_px = 0.0;      // of v_right - v_left: above 0, the right eye looks too far up
  double roll_deg = 0.0;       // the right image is turned so, clockwise as looked at
  double scale = 1.0;          // the right image is so much larger, from its rows
};

// Measures that from images. Rectifies both eyes as the odometry does, and looks for corners of the
// left eye in the right one, in the same row and some above and below.
// Claims its memory in create() and grows by its matches: for start-up only. Thread: one.
class EpipolarCheck {
 public:
  // @return kConfiguration when the rig makes no sense; kMinWidth and kMaxWidth bound the width.
  static Result<std::unique_ptr<EpipolarCheck>> create(const StereoRig& rig, int width_px,
                                                       const KernelTable& kernels);

  // Adds the matches of one pair. Cost: some 10 ms for 320x240 px.
  // @pre the images have the sizes of the rig's cameras.
  void add(const StereoFrame& frame);
  // Of all pairs so far.
  [[nodiscard]] EpipolarReport report() const;

 private:
  struct Match {
    double u_right = 0.0;  // px from the principal point
    double v_left = 0.0;   // px from the principal point
    double offset = 0.0;   // px, v_right - v_left
  };
  EpipolarCheck(const RectifiedRig& rig, const KernelTable& kernels);
  void match_corner(int x, int y);
  [[nodiscard]] double strongest_corner_in(int x0, int y0, int& x, int& y) const;

  const RectifiedRig rig_;
  const KernelTable kernels_;
  Arena arena_;
  FramePyramid left_;
  FramePyramid right_;
  std::span<std::uint8_t> scratch_;
  AreaMap left_map_;
  AreaMap right_map_;
  std::vector<int> costs_;  // of one corner: a row of disparities for each vertical offset
  int corners_ = 0;
  std::vector<Match> matches_;
};

}  // namespace darkling
