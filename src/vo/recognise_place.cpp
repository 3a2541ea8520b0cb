// SPDX-License-Identifier: Apache-2.0
#include "vo/recognise_place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vo/judge.h"

namespace darkling {

namespace {

// The grid of the search. Of frames that a keyframe's points moved by 30 to 60 px in (of 320), 0.48
// to 0.70 were recognised with this, 0.33 to 0.52 with 3 px, and with 1 px a tenth more.
constexpr int kShiftPx = 2;
// Alignments a frame, at most.
constexpr std::size_t kTrials = 3;
// Of 10 500 alignments of frames to the keyframes of their own recording, half of them out of
// sight, no wrong one was valid, which is below 0.6; of 12 000 to those of another the least cost
// 0.83.
constexpr double kMostCost = 0.55;
constexpr double kLeastVisible = 0.4;
// What two recognitions of one place may differ by, px of image motion at the finest level.
constexpr double kMostDifferencePx = 3.0;

// AlignmentScore::rank(), in single precision: point i goes to lane i mod 8. What stands behind the
// last point counts as points that left the image, the same at every rotation.
float rank_of(const PointResiduals& residuals, int count) {
  constexpr auto kTruncation = static_cast<float>(kDistanceTruncation);
  constexpr float kInverseTruncation = 1.0f / (kTruncation * kTruncation * kPlaneCount);
  std::array<float, kPointLanes> sums = {};
  for (int first = 0; first < count; first += kPointLanes) {
    for (int lane = 0; lane < kPointLanes; ++lane) {
      const float squares = residuals.squares[first + lane] * kInverseTruncation;
      sums[lane] += squares < 0.0f ? 0.5f : std::sqrt(std::min(squares, 1.0f));
    }
  }
  float sum = 0.0f;
  for (const float lane : sums) sum += lane;
  return sum / static_cast<float>(round_up_to_lanes(count));
}

Se3 pose_of(const Recognition& recognition) {
  return recognition.keyframe->T_world_key * recognition.alignment.T_current_key.inverse();
}

bool is_better(const Recognition& a, const Recognition& b) {
  if (a.keyframe->track != b.keyframe->track) return a.keyframe->track < b.keyframe->track;
  return a.alignment.score.cost < b.alignment.score.cost;
}

}  // namespace

void search_rotations(const KernelTable& kernels, const FramePyramid& frame,
                      const PointResiduals& scratch, std::span<RotationMatch> matches) {
  const std::size_t coarsest = frame.size() - 1;
  const PyramidLevel& level = frame[coarsest];
  const int most_x = level.grey.width / 2 / kShiftPx;
  const int most_y = level.grey.height / 2 / kShiftPx;
  for (int y = -most_y; y <= most_y; ++y) {
    for (int x = -most_x; x <= most_x; ++x) {
      const double stays_in_view = (1.0 - std::abs(x) * kShiftPx / double(level.grey.width)) *
                                   (1.0 - std::abs(y) * kShiftPx / double(level.grey.height));
      if (stays_in_view < kLeastVisible) continue;
      Vector6 xi = Vector6::Zero();
      xi[3] = -y * kShiftPx / level.focal_px;
      xi[4] = x * kShiftPx / level.focal_px;
      const Se3 T_current_key = Se3::exp(xi);
      const PointWarp warp = make_warp(T_current_key, level);
      for (RotationMatch& match : matches) {
        const TemplatePoints& points = match.keyframe->points.levels[coarsest].points;
        if (points.count == 0) continue;
        (void)kernels.sample_residuals(points, warp, level.planes, scratch);
        const float rank = rank_of(scratch, points.count);
        if (rank < match.rank) match = {match.keyframe, T_current_key, rank};
      }
    }
  }
}

bool is_beyond_doubt(const Alignment& alignment, const TemplateLevel& finest, double focal_px) {
  return judge_alignment(alignment, finest, focal_px).status == TrackStatus::kValid &&
         alignment.score.cost < kMostCost && alignment.score.visible_fraction > kLeastVisible;
}

std::optional<Recognition> recognise_place(const KernelTable& kernels, const KeyframeRing& ring,
                                           int before_track, const FramePyramid& frame,
                                           const PointResiduals& scratch) {
  FixedVector<RotationMatch, kRingKeyframes> matches;
  for (const RingKeyframe& key : ring.keyframes()) {
    if (key.track < before_track) (void)matches.push_back({&key, Se3(), kNothingAlike});
  }
  search_rotations(kernels, frame, scratch, {matches.data(), matches.size()});
  const std::size_t trials = std::min(matches.size(), kTrials);
  std::partial_sort(matches.begin(), matches.begin() + trials, matches.end(),
                    [](const RotationMatch& a, const RotationMatch& b) {
                      return a.rank != b.rank ? a.rank < b.rank : a.keyframe < b.keyframe;
                    });
  std::optional<Recognition> best;
  for (std::size_t i = 0; i < trials; ++i) {
    const RotationMatch& match = matches[i];
    const TemplateLevel& finest = match.keyframe->points.levels[0];
    const Recognition found = {match.keyframe, align_frame(kernels, match.keyframe->points, frame,
                                                           {&match.T_current_key, 1}, scratch)};
    if (!is_beyond_doubt(found.alignment, finest, frame[0].focal_px)) continue;
    if (best && best->keyframe->track == match.keyframe->track &&
        motion_px(minus(pose_of(*best), pose_of(found)),
                  static_cast<double>(finest.mean_inverse_depth_focal),
                  frame[0].focal_px) > kMostDifferencePx) {
      return std::nullopt;
    }
    if (!best || is_better(found, *best)) best = found;
  }
  return best;
}

}  // namespace darkling
