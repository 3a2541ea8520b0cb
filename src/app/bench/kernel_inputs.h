// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/arena.h"
#include "base/result.h"
#include "base/stereo_frame.h"
#include "geometry/stereo_rig.h"
#include "kernels/match_patch.h"
#include "kernels/normal_equations.h"
#include "vo/align.h"
#include "vo/frame_pyramid.h"
#include "vo/keyframe_template.h"
#include "vo/limits.h"
#include "vo/match_stereo.h"
#include "vo/odometry_config.h"

namespace darkling {

// Where the two kernels of the stereo refinement are called for a point.
struct CodeCandidate {
  const std::uint8_t* left;
  const std::uint8_t* right;
};
struct PlaneCandidate {
  const std::uint8_t* left;
  const std::uint8_t* right;
  int fraction_q12;
};

// What kernels work on, filled as Odometry fills it for a keyframe.
struct KernelInputs {
  KernelInputs(const RectifiedRig& rig_, std::size_t arena_bytes) : rig(rig_), arena(arena_bytes) {}

  RectifiedRig rig;
  Arena arena;
  ImageView<std::uint8_t> raw_left;
  AreaMap left_map;
  AreaMap right_map;
  FramePyramid left;
  FramePyramid right;
  std::span<std::uint8_t> plane_scratch;
  StereoMatcher matcher;
  DisparityPyramid disparities;
  PointSelector selector;
  PointResiduals residuals;
  KeyframeTemplate keyframe;  // its finest level alone is filled
  PointWarp warp;             // onto the same frame, from a pose a little beside the true one
  int search_count = 0;       // disparities that a CodeCandidate is tried at
  std::vector<CodeCandidate> code_candidates;
  std::vector<PlaneCandidate> plane_candidates;

  // Where results go that nobody looks at.
  NormalSums normal_sums;
  std::array<int, 2 * (1 << kMaxLevels)> search_costs = {};
  PatchFit patch_fit;
  PlanePatch patch;
};

// @return any error of Odometry::create(); kBadInput when the frame shows too little to find
// points.
[[nodiscard]] Result<std::unique_ptr<KernelInputs>> make_kernel_inputs(
    const StereoRig& rig, const StereoFrame& frame, const OdometryConfig& config);

}  // namespace darkling
