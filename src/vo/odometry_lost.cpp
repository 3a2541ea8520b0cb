// SPDX-License-Identifier: Apache-2.0
// What is done when a frame cannot be aligned to the keyframe: looked for where it may be, and at
// last begun anew.
#include <limits>

#include "vo/judge.h"
#include "vo/odometry_state.h"
#include "vo/stage_timer.h"

namespace darkling {

namespace {

// Frames lost in a row after which the keyframe is given up and the present frame becomes one.
constexpr int kLostFramesBeforeReset = 3;
// Of the right eye, which no alignment has fitted.
constexpr double kMostRightCost = 0.6;

}  // namespace

// The place of the frame in the ring, if both eyes see it, and what is known of its pose there.
std::optional<Recognition> Odometry::State::recognise(const StereoFrame& frame, int before_track,
                                                      Estimate& estimate) {
  std::optional<Recognition> found;
  {
    StageTimer timer(read_clock, estimate, Stage::kTrack);
    found = recognise_place(kernels, ring, before_track, left, residuals);
  }
  if (!found) return std::nullopt;
  if (judge_image(prepare_right(frame, estimate)).status == TrackStatus::kLost) return std::nullopt;
  StageTimer timer(read_clock, estimate, Stage::kTrack);
  const TemplateLevel& finest = found->keyframe->points.levels[0];
  const Alignment& alignment = found->alignment;
  const Se3 T_right_left(Eigen::Quaterniond::Identity(), Vector3(-rig.baseline_m, 0.0, 0.0));
  const PointWarp right_warp = make_warp(T_right_left * alignment.T_current_key, right[0]);
  (void)kernels.sample_residuals(finest.points, right_warp, right[0].planes, residuals);
  const AlignmentScore in_right =
      score_residuals(finest.points, residuals, right_warp, right[0].planes);
  if (in_right.cost > kMostRightCost) return std::nullopt;
  (void)kernels.sample_residuals(finest.points, make_warp(alignment.T_current_key, left[0]),
                                 left[0].planes, residuals);
  covariance.rebase(found->keyframe->covariance, kernels,
                    {.rig = rig, .finest = finest, .alignment = alignment, .residuals = residuals},
                    influences);
  return found;
}

// The frame shows a place of the ring: its pose is measured there, and it becomes the keyframe. How
// the vehicle came to be there is not known.
bool Odometry::State::find_again(const StereoFrame& frame, Estimate& estimate) {
  const PoseCovariance covariance_before = covariance;
  const std::optional<Recognition> found =
      recognise(frame, std::numeric_limits<int>::max(), estimate);
  if (!found) return false;
  const Se3 T_held = T_world_previous;
  const int held_track = track;
  T_world_previous = found->keyframe->T_world_key * found->alignment.T_current_key.inverse();
  track = found->keyframe->track;
  window.count = 0;
  if (!make_keyframe(frame, estimate)) {
    T_world_previous = T_held;
    track = held_track;
    covariance = covariance_before;
    return false;
  }
  T_world_reported = T_world_previous;
  unpublished.setZero();
  return true;
}

// After a while without: tracking starts again from the pose that is held.
bool Odometry::State::begin_track(const StereoFrame& frame, Estimate& estimate) {
  if (++lost_in_a_row < kLostFramesBeforeReset) return false;
  window.count = 0;  // nothing leads to it from here
  if (!make_keyframe(frame, estimate)) return false;
  covariance.reset();
  track = reset_counter + 1;
  ring.newest().track = track;
  ring.newest().covariance = covariance.keyframe();
  return true;
}

// The frame could not be aligned.
void Odometry::State::lose(const StereoFrame& frame, Estimate& estimate) {
  estimate.status = TrackStatus::kLost;
  estimate.quality = -1;
  T_before_previous.reset();
  // It may be another place, and what seemed to move there may not be a body.
  usual_sharpness = {};
  frames_to_watch = 0;
  frames_of_body = 0;
  const bool is_found = find_again(frame, estimate);
  if (is_found || begin_track(frame, estimate)) {
    ++reset_counter;
    previous_sequence = frame.sequence;
    lost_in_a_row = 0;
  }
  report(T_world_previous, estimate);
  if (is_found) {
    estimate.cov_world_body = transport_covariance(covariance.pose(), rig.T_body_left);
  }
}

// A track that began at a held pose is off by the way that was not seen. Where it comes upon a
// keyframe of an older track this way becomes known: all of it moves there. That is no motion of
// the vehicle, and the published pose takes it at one blow.
void Odometry::State::rejoin_track(const StereoFrame& frame, Estimate& estimate) {
  const std::optional<Recognition> found = recognise(frame, track, estimate);
  if (!found) return;
  const Se3 T_old_left = found->keyframe->T_world_key * found->alignment.T_current_key.inverse();
  const Se3 T_old_track = T_old_left * T_world_previous.inverse();
  for (Se3* T_world : {&T_world_key, &T_world_previous, &T_world_reported}) {
    *T_world = T_old_track * *T_world;
  }
  for (WindowKeyframe& key : window.keyframes()) key.T_world_key = T_old_track * key.T_world_key;
  const int old_track = found->keyframe->track;
  join_tracks(track, old_track, T_old_track, ring);
  track = old_track;
  ++reset_counter;
}

}  // namespace darkling
