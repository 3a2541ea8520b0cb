// SPDX-License-Identifier: Apache-2.0
#include "io/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace darkling {

namespace {

// What is written into messages as a number must mean the same there.
template <class A, class B>
constexpr bool is_same(A a, B b) {
  return static_cast<std::int64_t>(a) == static_cast<std::int64_t>(b);
}
static_assert(is_same(update_t::STATUS_UNKNOWN, TrackStatus::kUnknown));
static_assert(is_same(update_t::STATUS_VALID, TrackStatus::kValid));
static_assert(is_same(update_t::STATUS_DEGRADED, TrackStatus::kDegraded));
static_assert(is_same(update_t::STATUS_LOST, TrackStatus::kLost));
static_assert(is_same(pose_t::STATUS_UNKNOWN, TrackStatus::kUnknown));
static_assert(is_same(pose_t::STATUS_VALID, TrackStatus::kValid));
static_assert(is_same(pose_t::STATUS_DEGRADED, TrackStatus::kDegraded));
static_assert(is_same(pose_t::STATUS_LOST, TrackStatus::kLost));
static_assert(is_same(update_t::REASON_LOW_TEXTURE, kReasonLowTexture));
static_assert(is_same(update_t::REASON_LOW_OVERLAP, kReasonLowOverlap));
static_assert(is_same(update_t::REASON_NOT_CONVERGED, kReasonNotConverged));
static_assert(is_same(update_t::REASON_ILL_CONDITIONED, kReasonIllConditioned));
static_assert(is_same(update_t::REASON_RESIDUAL_HIGH, kReasonResidualHigh));
static_assert(is_same(update_t::REASON_DROPPED, kReasonDropped));
static_assert(is_same(update_t::REASON_NO_DEPTH, kReasonNoDepth));
static_assert(is_same(update_t::REASON_EYES_SWAPPED, kReasonEyesSwapped));
static_assert(is_same(update_t::REASON_TOO_DARK, kReasonTooDark));
static_assert(is_same(update_t::REASON_SATURATED, kReasonSaturated));
static_assert(is_same(update_t::REASON_FROZEN, kReasonFrozen));
static_assert(is_same(update_t::REASON_EYES_DISAGREE, kReasonEyesDisagree));
static_assert(is_same(update_t::REASON_CALIB_SUSPECT, kReasonCalibSuspect));
static_assert(is_same(update_t::REASON_MOVING_BODY, kReasonMovingBody));
static_assert(is_same(update_t::REASON_TORN, kReasonTorn));
static_assert(is_same(update_t::REASON_UNSYNCED, kReasonUnsynced));
static_assert(is_same(update_t::REASON_BLUR, kReasonBlur));
static_assert(is_same(update_t::REASON_STEP_TOO_LARGE, kReasonStepTooLarge));
static_assert(kReasonCount == 18, "a new reason needs its constant in update_t.lcm");

void write_transform(const Se3& T, double (&translation)[3], double (&rotation)[4]) {
  std::copy_n(T.translation().data(), 3, translation);
  const Eigen::Quaterniond& q = T.rotation();
  rotation[0] = q.w();
  rotation[1] = q.x();
  rotation[2] = q.y();
  rotation[3] = q.z();
}

void write_covariance(const Matrix6& cov, double (&covariance)[36]) {
  for (int i = 0; i < 36; ++i) covariance[i] = cov(i / 6, i % 6);
}

// What both messages say alike.
template <class Message>
void write_common(const Estimate& estimate, Duration epoch_offset, Message& message) {
  message.utime = (estimate.stamp.time_since_epoch() + epoch_offset).count() / 1000;
  message.mono_ns = to_ns(estimate.stamp);
  message.seq = estimate.sequence;
  message.reset_counter = estimate.reset_counter;
  message.status = static_cast<std::int8_t>(estimate.status);
  message.quality = static_cast<std::int8_t>(estimate.quality);
}

// Of a body that moved by T_previous_body in `period` at a constant twist (velocity, angular
// velocity) in Body; NaN where that is not measured.
Vector6 mean_twist(const Estimate& estimate, std::optional<Duration> period) {
  const bool is_measured = estimate.status != TrackStatus::kLost && period.has_value() &&
                           *period > Duration::zero() &&
                           estimate.cov_previous_body(0, 0) < update_t::UNKNOWN_VARIANCE;
  if (!is_measured) return Vector6::Constant(std::numeric_limits<double>::quiet_NaN());
  return estimate.T_previous_body.log() / std::chrono::duration<double>(*period).count();
}

}  // namespace

void EstimateMessages::fill(const Estimate& estimate, Duration epoch_offset) {
  update_.prev_utime = update_.utime;  // of the message before: receivers chain by it
  write_common(estimate, epoch_offset, update_);
  update_.reasons = static_cast<std::int32_t>(estimate.reasons);
  write_transform(estimate.T_previous_body, update_.translation, update_.rotation);
  write_covariance(estimate.cov_previous_body, update_.covariance);

  write_common(estimate, epoch_offset, pose_);
  write_transform(estimate.T_world_body, pose_.translation, pose_.rotation);
  write_covariance(estimate.cov_world_body, pose_.covariance);
  std::optional<Duration> period;
  if (previous_stamp_) period = estimate.stamp - *previous_stamp_;
  const Vector6 twist = mean_twist(estimate, period);
  std::copy_n(twist.data(), 3, pose_.velocity);
  std::copy_n(twist.data() + 3, 3, pose_.angular_velocity);
  previous_stamp_ = estimate.stamp;
}

bot_core::pose_t EstimateMessages::bot_core_pose() const {
  bot_core::pose_t pose = {};
  pose.utime = pose_.utime;
  std::copy_n(pose_.translation, 3, pose.pos);
  std::copy_n(pose_.rotation, 4, pose.orientation);
  const Vector3 v_body(pose_.velocity[0], pose_.velocity[1], pose_.velocity[2]);
  if (!v_body.allFinite()) return pose;
  const Eigen::Quaterniond q_world_body(pose_.rotation[0], pose_.rotation[1], pose_.rotation[2],
                                        pose_.rotation[3]);
  const Vector3 v_world = q_world_body * v_body;
  std::copy_n(v_world.data(), 3, pose.vel);
  std::copy_n(pose_.angular_velocity, 3, pose.rotation_rate);
  return pose;
}

}  // namespace darkling
