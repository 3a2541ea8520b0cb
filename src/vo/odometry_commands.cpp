// SPDX-License-Identifier: Apache-2.0
// What can be asked of an odometry between frames.
#include "vo/odometry.h"
#include "vo/odometry_state.h"

namespace darkling {

void Odometry::hint(const Se3& T_previous_body) {
  const Se3& T_body_left = state_->rig.T_body_left;
  state_->hinted = T_body_left.inverse() * T_previous_body * T_body_left;
}

void Odometry::reseed() {
  state_->is_reseed_wanted = true;
}

void Odometry::reset() {
  State& s = *state_;
  s.finish_refinement();
  for (TemplateLevel& level : s.keyframe.levels) level.points.count = 0;
  s.window.count = 0;
  s.ring.count = 0;
  for (Se3* T : {&s.T_world_key, &s.T_world_previous, &s.T_world_reported}) *T = Se3();
  s.T_before_previous.reset();
  s.unpublished.setZero();
  s.motion_gap = 1;
  s.lost_in_a_row = 0;
  s.hinted.reset();
  s.is_reseed_wanted = false;
  s.frames_since_look = 0;
  s.do_eyes_disagree = false;
  s.looks_alike = 0;
  s.misplaced_looks = 0;
  s.frames_to_watch = 0;
  s.frames_of_body = 0;
  s.previous_measure = {};
  s.frames_to_doubt = 0;
  s.usual_sharpness = {};
  s.is_reported_measured = false;
  s.covariance.reset();
  ++s.reset_counter;
}

}  // namespace darkling
