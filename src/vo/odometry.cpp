// SPDX-License-Identifier: Apache-2.0
#include "vo/odometry.h"

#include <algorithm>
#include <array>
#include <utility>

#include "vo/judge.h"
#include "vo/odometry_state.h"
#include "vo/stage_timer.h"

namespace darkling {

namespace {

// Share of points that fit nothing above which a second motion is looked for. A body is noticed by
// this when it moves by some pixels more than the world; then it is kept an eye on.
constexpr double kSuspiciousMisfits = 0.08;
constexpr int kFramesToWatch = 20;
// For so many frames after one it is not taken to be gone: when both stand still, for one, nothing
// tells them apart.
constexpr int kFramesOfBody = 5;
// A body may lead the coarse levels astray, where the vehicle moves on as it did.
constexpr int kFineLevels = 2;
// Off the motion that went on, of the image's width. Vehicles are off by 1.4 % at most, at a third
// of the frames by 4.6 %; what aligns by chance, by anything.
constexpr double kMaxSurprise = 0.05;
// Beyond these, a motion that was measured says nothing of where the vehicle is.
constexpr std::int64_t kMaxPredictedFrames = 10;
// Of the alignment that ends a longer gap. Of 60 such, in all recordings, right ones cost 0.65 at
// most and saw a third of the points; wrong ones that are not lost by themselves cost 0.71 or more,
// or 0.67 with a fifth of the points.
constexpr double kMostCostAfterGap = 0.68;
constexpr double kLeastVisibleAfterGap = 0.25;
// Of what refinement moved the keyframe by, the published pose follows this share a frame. At once
// was tried: a step of a millimetre every sixth frame raised the RPE of rendered drives by a tenth.
constexpr double kPublishedShare = 0.1;

}  // namespace

// The image of the newest keyframe stays as it is until the next frame: until then, the window
// belongs to whoever refines it.
void Odometry::State::start_refinement() {
  is_refinement_due = config.refinement && window.count >= kMinWindowKeyframes;
  if (!is_refinement_due || runner == nullptr) return;
  runner->start([](void* state) { static_cast<State*>(state)->refine(); }, this);
}

void Odometry::State::refine() {
  const MonotonicTime start = read_clock();
  refinement = refine_window(kernels, left[0], equations, window);
  refinement_time = read_clock() - start;
}

// Moves the keyframe, and what hangs on it, to where the refinement puts it. That is no motion of
// the vehicle: the published pose follows over the frames to come.
void Odometry::State::finish_refinement() {
  if (!is_refinement_due) return;
  is_refinement_due = false;
  if (runner == nullptr) {
    refine();
  } else {
    refinement_overruns += runner->wait() ? 0 : 1;
  }
  is_refinement_news = true;
  if (refinement != Refinement::kApplied) return;
  const Se3 T_new_old = window.newest().T_world_key.inverse() * T_world_key;
  unpublished = (T_new_old * Se3::exp(unpublished)).log();
  const Se3 T_before_key = T_world_key.inverse();
  for (Se3* T_world : {&T_world_previous, &T_world_reported}) {
    *T_world = window.newest().T_world_key * T_before_key * *T_world;
  }
  T_world_key = window.newest().T_world_key;
  follow_window(window, ring);
}

// What a vehicle cannot do is not taken for sure, however well the images match. It may have been
// pushed, all the same.
void Odometry::State::note_surprise(const Se3& T_world_left, Estimate& estimate) const {
  if (!T_before_previous) return;
  const Vector6 off = minus(T_world_left, predict(estimate.sequence));
  const auto inverse_depth_focal = static_cast<double>(keyframe.levels[0].mean_inverse_depth_focal);
  if (motion_px(off, inverse_depth_focal, rig.focal_px) > kMaxSurprise * rig.width) {
    note(kReasonStepTooLarge, TrackStatus::kDegraded, estimate);
  }
}

// Looks for a second motion where there may be one: much does not fit, or there was one just now.
// Not after frames that are not predicted: it would start from anywhere.
void Odometry::State::watch_for_bodies(std::span<const Se3> guesses, Alignment& alignment,
                                       Estimate& estimate) {
  if (estimate.sequence - previous_sequence > kMaxPredictedFrames) return;
  if (frames_to_watch == 0 &&
      share_of_misfits(keyframe.levels[0].points, residuals) < kSuspiciousMisfits) {
    return;
  }
  const Alignment fine =
      align_frame(kernels, keyframe, left, guesses.first(1), residuals, kFineLevels);
  if (fine.score.rank() < alignment.score.rank()) alignment = fine;
  const MotionCount count = separate_motions({.kernels = kernels,
                                              .keyframe = keyframe,
                                              .frame = left,
                                              .guesses = guesses,
                                              .residuals = residuals,
                                              .scratch = motions,
                                              .is_expected = frames_of_body > 0},
                                             alignment);
  const auto count_down = [](bool is_anew, int from, int& frames) {
    frames = is_anew ? from : std::max(frames - 1, 0);
  };
  // After a gap much has left the image that the keyframe shows: it may look like a body, once.
  const bool is_after_gap = estimate.sequence - previous_sequence > 1;
  count_down(count == MotionCount::kTwo && !is_after_gap, kFramesOfBody, frames_of_body);
  count_down(count != MotionCount::kOne && !is_after_gap, kFramesToWatch, frames_to_watch);
  const bool was_just_seen = frames_to_watch > kFramesToWatch - kFramesOfBody;
  if (count != MotionCount::kOne || was_just_seen) {
    note(kReasonMovingBody, TrackStatus::kDegraded, estimate);
  }
}

// T_world_left of frame `sequence` if the last measured motion goes on, which it does not for ever.
Se3 Odometry::State::predict(std::int64_t sequence) const {
  if (!T_before_previous) return T_world_previous;
  const std::int64_t frames = std::min(sequence - previous_sequence, kMaxPredictedFrames);
  const double ratio =
      static_cast<double>(frames) / static_cast<double>(std::max<std::int64_t>(motion_gap, 1));
  return T_world_previous * Se3::exp(ratio * T_before_previous->log());
}

// Beyond the frames that are predicted the guesses are no better than any other, and the alignment
// may have come from afar.
bool Odometry::State::is_doubtful(const AlignmentScore& score, std::int64_t sequence) const {
  return sequence - previous_sequence > kMaxPredictedFrames &&
         (score.cost > kMostCostAfterGap || score.visible_fraction < kLeastVisibleAfterGap);
}

void Odometry::State::accept(const Se3& T_world_left, std::int64_t sequence) {
  T_before_previous = T_world_previous.inverse() * T_world_left;
  motion_gap = sequence - previous_sequence;
  T_world_previous = T_world_left;
  previous_sequence = sequence;
  lost_in_a_row = 0;
}

// Fills what follows from the pose: the body's pose and its motion since the last estimate, and
// what became of a refinement meanwhile.
void Odometry::State::report(const Se3& T_world_left, Estimate& estimate) {
  const Se3 T_left_body = rig.T_body_left.inverse();
  estimate.T_world_left = T_world_left * Se3::exp(unpublished);
  unpublished *= 1.0 - kPublishedShare;
  estimate.T_world_body = rig.T_body_left * estimate.T_world_left * T_left_body;
  estimate.T_previous_body =
      rig.T_body_left * T_world_reported.inverse() * T_world_left * T_left_body;
  estimate.reset_counter = reset_counter;
  T_world_reported = T_world_left;
  report_covariance(estimate);
  if (!std::exchange(is_refinement_news, false)) return;
  estimate.refinement = refinement;
  estimate.stage_times[static_cast<std::size_t>(Stage::kRefine)] = refinement_time;
}

// A motion is known from one measured pose, or from where tracking starts anew, to the next.
void Odometry::State::report_covariance(Estimate& estimate) {
  const bool is_measured = estimate.status != TrackStatus::kLost;
  estimate.cov_previous_body = is_measured && is_reported_measured
                                   ? transport_covariance(covariance.motion(), rig.T_body_left)
                                   : unknown_covariance();
  estimate.cov_world_body =
      is_measured ? transport_covariance(covariance.pose(), rig.T_body_left) : unknown_covariance();
  is_reported_measured = is_measured || estimate.is_keyframe;
}

Estimate Odometry::track(const StereoFrame& frame) {
  State& s = *state_;
  s.finish_refinement();
  Estimate estimate;
  estimate.sequence = frame.sequence;
  estimate.stamp = frame.stamp;
  const ImageMeasure measure = s.prepare_left(frame, estimate);
  const ImageJudgement seen = judge_image(measure);
  estimate.status = seen.status;
  estimate.reasons = seen.reasons;
  s.note_repeats(measure, estimate);
  if (estimate.status == TrackStatus::kLost) return s.pass_over(estimate), estimate;
  s.note_blur(measure, estimate);
  if (s.keyframe.is_empty()) return s.start(frame, estimate), estimate;

  const std::array<Se3, 3> guesses = {
      s.predict(frame.sequence).inverse() * s.T_world_key,
      s.T_world_previous.inverse() * s.T_world_key,
      (s.T_world_previous * s.hinted.value_or(Se3())).inverse() * s.T_world_key};
  const std::size_t guess_count = std::exchange(s.hinted, std::nullopt) ? 3 : 2;
  Alignment alignment;
  {
    StageTimer timer(s.read_clock, estimate, Stage::kTrack);
    const std::span from = std::span(guesses).first(guess_count);
    alignment = align_frame(s.kernels, s.keyframe, s.left, from, s.residuals);
    s.watch_for_bodies(from, alignment, estimate);
  }
  const Judgement judgement = judge_alignment(alignment, s.keyframe.levels[0], s.rig.focal_px);
  estimate.status = std::max(estimate.status, judgement.status);
  estimate.reasons |= judgement.reasons;
  estimate.quality = judgement.quality;
  estimate.point_count = alignment.score.visible_count;
  estimate.visible_fraction = alignment.score.visible_fraction;
  estimate.cost = alignment.score.cost;
  estimate.iterations = alignment.iterations;
  if (estimate.status == TrackStatus::kLost || s.is_doubtful(alignment.score, frame.sequence)) {
    return s.lose(frame, estimate), estimate;
  }

  {
    StageTimer timer(s.read_clock, estimate, Stage::kTrack);
    s.covariance.move(s.kernels,
                      {.rig = s.rig,
                       .finest = s.keyframe.levels[0],
                       .alignment = alignment,
                       .residuals = s.residuals},
                      s.influences);
  }
  const Se3 T_world_left = s.T_world_key * alignment.T_current_key.inverse();
  const bool is_hinted = guess_count == guesses.size();
  if (!is_hinted) s.note_surprise(T_world_left, estimate);
  s.accept(T_world_left, frame.sequence);
  if (judgement.is_keyframe_due || s.is_reseed_wanted) {
    s.rejoin_track(frame, estimate);
    const bool is_made = s.make_keyframe(frame, estimate);
    s.is_reseed_wanted &= !is_made;
    if (!is_made) estimate.status = std::max(estimate.status, TrackStatus::kDegraded);
  } else {
    s.look_at_right_eye(frame, alignment.T_current_key, estimate);
  }
  s.report_eyes(estimate);
  s.report(s.T_world_previous, estimate);
  return estimate;
}

// The first frame with enough depth is the first keyframe, at the pose held so far.
void Odometry::State::start(const StereoFrame& frame, Estimate& estimate) {
  previous_sequence = frame.sequence;
  if (make_keyframe(frame, estimate)) {
    const bool is_sure = (estimate.reasons & kReasonNoDepth) == 0;
    if (!is_sure) estimate.status = std::max(estimate.status, TrackStatus::kDegraded);
    estimate.quality = is_sure ? 100 : 1;
    estimate.visible_fraction = 1.0;
    estimate.point_count = keyframe.levels[0].points.count;
  } else {
    estimate.status = TrackStatus::kLost;
    estimate.quality = -1;
  }
  report(T_world_previous, estimate);
}

// Nothing was seen: the pose is predicted, and tracking goes on from where it was.
void Odometry::State::pass_over(Estimate& estimate) {
  estimate.status = TrackStatus::kLost;
  estimate.quality = -1;
  report(keyframe.is_empty() ? T_world_previous : predict(estimate.sequence), estimate);
}

void Odometry::finish_refinement() {
  state_->finish_refinement();
}

Estimate Odometry::skip(std::int64_t sequence, FrameTime stamp, Reason reason) {
  State& s = *state_;
  s.finish_refinement();
  Estimate estimate;
  estimate.sequence = sequence;
  estimate.stamp = stamp;
  estimate.reasons = reason;
  s.pass_over(estimate);
  return estimate;
}

}  // namespace darkling
