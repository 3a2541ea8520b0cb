// SPDX-License-Identifier: Apache-2.0
#include "vo/odometry.h"

#include <algorithm>
#include <array>
#include <utility>

#include "vo/judge.h"
#include "vo/odometry_state.h"
#include "vo/refine_disparity.h"

namespace darkling {

namespace {

// Frames lost in a row after which the keyframe is given up and the present frame becomes one.
constexpr int kLostFramesBeforeReset = 3;
// Fewer points with a depth than this do not make a keyframe.
constexpr int kMinKeyframePoints = 60;
// Of what refinement moved the keyframe by, the published pose follows this share a frame. At once
// was tried: a step of a millimetre every sixth frame raised the RPE of rendered drives by a tenth.
constexpr double kPublishedShare = 0.1;

// Adds the time a stage took to its entry.
class StageTimer {
 public:
  StageTimer(Odometry::ReadClock read_clock, Estimate& estimate, Stage stage)
      : read_clock_(read_clock),
        time_(estimate.stage_times[static_cast<std::size_t>(stage)]),
        start_(read_clock()) {}
  ~StageTimer() { time_ += read_clock_() - start_; }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Odometry::ReadClock read_clock_;
  Duration& time_;
  MonotonicTime start_;
};

}  // namespace

// Turns the present frame, whose left pyramid is built and whose pose is known, into the keyframe.
// @return false, and the old keyframe stays, when the pair shows too little depth.
bool Odometry::State::make_keyframe(const StereoFrame& frame, Estimate& estimate) {
  {
    StageTimer timer(read_clock, estimate, Stage::kRectify);
    kernels.remap_area(right_map, frame.right, right[0].grey);
  }
  {
    StageTimer timer(read_clock, estimate, Stage::kPlanes);
    build_pyramid(kernels, right);
    for (PyramidLevel& level : right) compute_planes(kernels, plane_scratch, level);
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
      search_disparities(kernels, left[0], right[0], disparities.dense_level, chosen);
      refine_disparities(kernels, left[0], right[0], chosen);
      chosen = drop_unknown(chosen);
      if (static_cast<int>(chosen.size()) < kMinKeyframePoints) return false;
    }
    build_template_level(kernels, chosen, left[l], rig.baseline_m, keyframe.levels[l]);
    if (l == 0 && config.refinement) add_to_window(chosen);
  }
  T_world_key = T_world_previous;
  covariance.set_keyframe();
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
}

// Brings the frame's left eye into the shape that everything else works on.
void Odometry::State::prepare_left(const StereoFrame& frame, Estimate& estimate) {
  {
    StageTimer timer(read_clock, estimate, Stage::kRectify);
    kernels.remap_area(left_map, frame.left, left[0].grey);
  }
  {
    StageTimer timer(read_clock, estimate, Stage::kPyramid);
    build_pyramid(kernels, left);
  }
  StageTimer timer(read_clock, estimate, Stage::kPlanes);
  for (PyramidLevel& level : left) compute_planes(kernels, plane_scratch, level);
}

// T_world_left of frame `sequence` if the last measured motion goes on.
Se3 Odometry::State::predict(std::int64_t sequence) const {
  const double ratio = static_cast<double>(sequence - previous_sequence) /
                       static_cast<double>(std::max<std::int64_t>(motion_gap, 1));
  return T_world_previous * Se3::exp(ratio * T_before_previous.log());
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

// The frame could not be aligned: hold the pose; after a while start again from here.
void Odometry::State::lose(const StereoFrame& frame, Estimate& estimate) {
  estimate.status = TrackStatus::kLost;
  estimate.quality = -1;
  T_before_previous = Se3();
  if (++lost_in_a_row >= kLostFramesBeforeReset) window.count = 0;  // nothing leads to it from here
  if (lost_in_a_row >= kLostFramesBeforeReset && make_keyframe(frame, estimate)) {
    ++reset_counter;
    covariance.reset();
    previous_sequence = frame.sequence;
    lost_in_a_row = 0;
  }
  report(T_world_previous, estimate);
}

Estimate Odometry::track(const StereoFrame& frame) {
  State& s = *state_;
  s.finish_refinement();
  Estimate estimate;
  estimate.sequence = frame.sequence;
  estimate.stamp = frame.stamp;
  s.prepare_left(frame, estimate);
  if (s.keyframe.is_empty()) return s.start(frame, estimate), estimate;

  const std::array<Se3, 3> guesses = {
      s.predict(frame.sequence).inverse() * s.T_world_key,
      s.T_world_previous.inverse() * s.T_world_key,
      (s.T_world_previous * s.hinted.value_or(Se3())).inverse() * s.T_world_key};
  const std::size_t guess_count = std::exchange(s.hinted, std::nullopt) ? 3 : 2;
  Alignment alignment;
  {
    StageTimer timer(s.read_clock, estimate, Stage::kTrack);
    alignment = align_frame(s.kernels, s.keyframe, s.left, std::span(guesses).first(guess_count),
                            s.residuals);
  }
  const Judgement judgement = judge_alignment(alignment, s.keyframe.levels[0], s.rig.focal_px);
  estimate.status = judgement.status;
  estimate.reasons = judgement.reasons;
  estimate.quality = judgement.quality;
  estimate.point_count = alignment.score.visible_count;
  estimate.visible_fraction = alignment.score.visible_fraction;
  estimate.cost = alignment.score.cost;
  estimate.iterations = alignment.iterations;
  if (judgement.status == TrackStatus::kLost) return s.lose(frame, estimate), estimate;

  {
    StageTimer timer(s.read_clock, estimate, Stage::kTrack);
    s.covariance.move(s.kernels,
                      {.rig = s.rig,
                       .finest = s.keyframe.levels[0],
                       .alignment = alignment,
                       .residuals = s.residuals},
                      s.influences);
  }
  s.accept(s.T_world_key * alignment.T_current_key.inverse(), frame.sequence);
  if (judgement.is_keyframe_due || s.is_reseed_wanted) {
    s.is_reseed_wanted &= !s.make_keyframe(frame, estimate);
  }
  s.report(s.T_world_previous, estimate);
  return estimate;
}

// The first frame with enough depth is the first keyframe, at the pose held so far.
void Odometry::State::start(const StereoFrame& frame, Estimate& estimate) {
  previous_sequence = frame.sequence;
  if (make_keyframe(frame, estimate)) {
    estimate.status = TrackStatus::kValid;
    estimate.quality = 100;
    estimate.visible_fraction = 1.0;
    estimate.point_count = keyframe.levels[0].points.count;
  } else {
    estimate.status = TrackStatus::kLost;
    if (estimate.reasons == kReasonNone) estimate.reasons = kReasonNoDepth;
    estimate.quality = -1;
  }
  report(T_world_previous, estimate);
}

void Odometry::finish_refinement() {
  state_->finish_refinement();
}

Estimate Odometry::skip(std::int64_t sequence, FrameTime stamp) {
  State& s = *state_;
  s.finish_refinement();
  Estimate estimate;
  estimate.sequence = sequence;
  estimate.stamp = stamp;
  estimate.status = TrackStatus::kLost;
  estimate.reasons = kReasonDropped;
  estimate.quality = -1;
  s.report(s.keyframe.is_empty() ? s.T_world_previous : s.predict(sequence), estimate);
  return estimate;
}

}  // namespace darkling
