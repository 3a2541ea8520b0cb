// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "vo/judge.h"
#include "vo/odometry_state.h"
#include "vo/refine_disparity.h"
#include "vo/stage_timer.h"

namespace darkling {

namespace {

// Fewer points with a depth than this do not make a keyframe, nor do those that are a smaller share
// of the points that were looked for: in noise, with an eye covered or of another scene a chance
// match is found for 0.05 to 0.55 of them, of real ones, however dark, for 0.44 to 0.95. Noise that
// passes is found out by the next frame; a start, which has none before it, says its doubt itself.
constexpr int kMinKeyframePoints = 60;
constexpr double kMinKeyframeShare = 0.45;
constexpr double kSureShare = 0.6;
// Nor do points that are next to all at infinity: one image in both eyes, or nothing within sight.
constexpr float kNearPx = 0.25f;
constexpr double kMinNearShare = 0.02;

// Share of the points looked for that a depth was found for; 0 when those found are too few or too
// far to track by.
double depth_share(std::span<const PointSelector::Candidate> found, std::size_t wanted) {
  const auto near =
      std::count_if(found.begin(), found.end(),
                    [](const PointSelector::Candidate& c) { return c.disparity_px >= kNearPx; });
  const auto count = static_cast<double>(found.size());
  const bool is_enough = static_cast<int>(found.size()) >= kMinKeyframePoints &&
                         static_cast<double>(near) >= kMinNearShare * count;
  return is_enough ? count / static_cast<double>(wanted) : 0.0;
}

}  // namespace

// The same of the right eye, as far as it is used.
ImageMeasure Odometry::State::prepare_right(const StereoFrame& frame, Estimate& estimate) {
  {
    StageTimer timer(read_clock, estimate, Stage::kRectify);
    kernels.remap_area(right_map, frame.right, right[0].grey);
  }
  StageTimer timer(read_clock, estimate, Stage::kPlanes);
  const ImageMeasure measure = build_pyramid(kernels, right);
  for (PyramidLevel& level : right) compute_planes(kernels, plane_scratch, level);
  return measure;
}

// Turns the present frame, whose left pyramid is built and whose pose is known, into the keyframe.
// @return false, with the reason, and the old keyframe stays, when the pair shows too little depth
// or
//         the right eye not what the old keyframe foretells.
bool Odometry::State::make_keyframe(const StereoFrame& frame, Estimate& estimate) {
  const ImageJudgement seen = judge_image(prepare_right(frame, estimate));
  if (seen.status == TrackStatus::kLost) {
    estimate.reasons |= seen.reasons | kReasonNoDepth;
    return false;
  }
  if (!keyframe.is_empty() && estimate.status != TrackStatus::kLost) {
    compare_eyes(T_world_previous.inverse() * T_world_key);
    // A pose in doubt may itself be why the right eye sees something else.
    if (do_eyes_disagree && estimate.status == TrackStatus::kValid) return false;
  }
  {
    StageTimer timer(read_clock, estimate, Stage::kStereo);
    const int dense = disparities.dense_level;
    if (!keyframe.is_empty()) {
      (void)match_stereo(kernels, left[dense].codes, right[dense].codes, matcher,
                         disparities.levels[0]);
    } else if (are_eyes_swapped(kernels, left[dense].codes, right[dense].codes, matcher,
                                disparities.levels[0])) {
      estimate.reasons |= kReasonEyesSwapped;
      return false;
    }
    reduce_disparities(disparities);
  }
  StageTimer timer(read_clock, estimate, Stage::kSelect);
  for (int l = 0; l < static_cast<int>(left.size()); ++l) {
    std::span<PointSelector::Candidate> chosen =
        select_points(kernels, left[l], disparities.at_level(l),
                      selector.for_at_most(keyframe.levels[l].capacity));
    if (l == 0) {
      const std::size_t wanted = chosen.size();
      search_disparities(kernels, left[0], right[0], disparities.dense_level, chosen);
      refine_disparities(kernels, left[0], right[0], chosen);
      chosen = drop_unknown(chosen);
      const double share = depth_share(chosen, wanted);
      if (share < (keyframe.is_empty() ? kSureShare : kMinKeyframeShare)) {
        estimate.reasons |= kReasonNoDepth;
      }
      if (share < kMinKeyframeShare) return false;
    }
    build_template_level(kernels, chosen, left[l], rig.baseline_m, keyframe.levels[l]);
    if (l == 0 && config.refinement) add_to_window(chosen);
  }
  T_world_key = T_world_previous;
  covariance.set_keyframe();
  add_to_ring(track, T_world_key, covariance.keyframe(), keyframe, ring);
  estimate.is_keyframe = true;
  start_refinement();
  return true;
}

// The template's finest level takes over what the window knows, and becomes part of it.
void Odometry::State::add_to_window(std::span<const PointSelector::Candidate> measured) {
  TemplatePoints& points = keyframe.levels[0].points;
  (void)carry_depths(window, T_world_previous, left[0], measured, point_image, points);
  add_keyframe(T_world_previous, points, measured, window);
}

}  // namespace darkling
