// SPDX-License-Identifier: Apache-2.0
#include "app/known_poses.h"

namespace darkling {

bool is_rectified(const StereoRig& rig) {
  constexpr double kTolerance = 1e-9;  // rad, and of the baseline's length
  const Camera& left = rig.left;
  const Camera& right = rig.right;
  const bool is_pinhole =
      left.distortion == Distortion::kNone && right.distortion == Distortion::kNone;
  const bool is_alike = left.fx == right.fx && left.fy == right.fy && left.cx == right.cx &&
                        left.cy == right.cy && left.width == right.width;
  const Se3 T_left_right = rig.T_body_rawleft.inverse() * rig.T_body_rawright;
  const Vector3& b = T_left_right.translation();
  return is_pinhole && is_alike && rotation_angle(T_left_right) < kTolerance &&
         b.tail<2>().norm() < kTolerance * b.norm();
}

KnownPoses::KnownPoses(const std::optional<Trajectory>& truth, const StereoRig& rig) {
  if (!truth) return;
  const bool is_left = truth->frame == PoseFrame::kLeft;
  if (is_left && !is_rectified(rig)) return;
  key_ = truth->key;
  if (is_left) T_pose_body_ = rig.T_body_rawleft.inverse();
  for (const TimedPose& pose : truth->poses) poses_.emplace(to_ns(pose.stamp), pose.T_world_pose);
}

std::optional<Se3> KnownPoses::find(std::int64_t sequence, FrameTime stamp) const {
  const auto found = poses_.find(key_ == PoseKey::kRow ? sequence : to_ns(stamp));
  if (found == poses_.end()) return std::nullopt;
  const Eigen::Affine3d& T = found->second;
  return Se3(Matrix3(T.linear()), Vector3(T.translation())) * T_pose_body_;
}

}  // namespace darkling
