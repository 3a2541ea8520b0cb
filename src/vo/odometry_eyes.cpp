// SPDX-License-Identifier: Apache-2.0
// Whether the right eye still sees what the left eye's keyframe foretells. Tracking itself looks
// through the left eye only; what is wrong with the right one would show as wrong depth, later.
#include <cmath>

#include "vo/judge.h"
#include "vo/odometry_state.h"

namespace darkling {

namespace {

// Frames after which the right eye is looked at even if no keyframe is due. One that shows
// something else is looked at in every frame, and believed again when it was right so many times in
// a row: what it shows may look alike once.
constexpr int kFramesBetweenLooks = 5;
constexpr int kLooksBeforeTrust = 3;
constexpr int kAlignSteps = 3;
// Cameras that are where the calibration says are met within 0.12 px of height, and of 0.17 at the
// edge, in good light; within 0.12 and 0.38 at 15 electrons a pixel (310 and 320 px). One that was
// turned by half a degree shows half of it: the alignment starts where nothing is turned.
constexpr double kMaxHeightPx = 0.4;
constexpr double kMaxRollAtEdgePx = 0.5;
// A stone that moves or a bad pose misleads once; a camera that was knocked stays so.
constexpr int kLooksBeforeSuspicion = 3;

// By how much the right image lies beside where it should.
struct Misplacement {
  double height_px = 0.0;
  double roll_rad = 0.0;
};

// Aligns the template to the right image, from where it should be.
Misplacement misplacement_of(const KernelTable& kernels, const TemplateLevel& level,
                             const PyramidLevel& right, const PointResiduals& residuals,
                             const Se3& T_should_key) {
  Alignment found;
  found.T_current_key = T_should_key;
  align_level(kernels, level, right, {.iterations = kAlignSteps}, residuals, found);
  // A small motion (t, ω) of what is seen moves it down by t_y f / z - f ω_x + ω_z u.
  const Vector6 off = (found.T_current_key * T_should_key.inverse()).log();
  return {.height_px = off[1] * static_cast<double>(level.mean_inverse_depth_focal) -
                       off[3] * right.focal_px,
          .roll_rad = off[5]};
}

}  // namespace

// @pre the right eye's planes are those of the frame whose left eye was aligned.
void Odometry::State::compare_eyes(const Se3& T_left_key) {
  frames_since_look = 0;
  const Se3 T_right_left(Eigen::Quaterniond::Identity(), Vector3(-rig.baseline_m, 0.0, 0.0));
  const Se3 T_right_key = T_right_left * T_left_key;
  const TemplateLevel& level = keyframe.levels[0];
  const PointWarp warp = make_warp(T_right_key, right[0]);
  const int visible = kernels.sample_residuals(level.points, warp, right[0].planes, residuals);
  if (visible < level.points.count / 4) return;  // too little to say anything
  const bool is_alike =
      !is_unrelated(score_residuals(level.points, residuals, warp, right[0].planes));
  looks_alike = is_alike ? looks_alike + 1 : 0;
  do_eyes_disagree = !is_alike || (do_eyes_disagree && looks_alike < kLooksBeforeTrust);
  if (!is_alike) return;
  const Misplacement off = misplacement_of(kernels, level, right[0], residuals, T_right_key);
  const bool is_off = std::abs(off.height_px) > kMaxHeightPx ||
                      std::abs(off.roll_rad) * 0.5 * rig.width > kMaxRollAtEdgePx;
  misplaced_looks = is_off ? misplaced_looks + 1 : 0;
}

// Between keyframes.
void Odometry::State::look_at_right_eye(const StereoFrame& frame, const Se3& T_left_key,
                                        Estimate& estimate) {
  if (++frames_since_look < kFramesBetweenLooks && !do_eyes_disagree) return;
  prepare_right(frame, estimate);
  compare_eyes(T_left_key);
}

void Odometry::State::report_eyes(Estimate& estimate) const {
  if (do_eyes_disagree) note(kReasonEyesDisagree, TrackStatus::kDegraded, estimate);
  if (misplaced_looks >= kLooksBeforeSuspicion) {
    note(kReasonCalibSuspect, TrackStatus::kDegraded, estimate);
  }
}

}  // namespace darkling
