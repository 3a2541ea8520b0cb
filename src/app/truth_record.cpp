// SPDX-License-Identifier: Apache-2.0
#include "app/truth_record.h"

#include <cstdlib>

namespace darkling {

namespace {

constexpr std::int64_t kMaxKey = std::int64_t{1} << 61;  // for differences without overflow
constexpr double kRigidTolerance = 1e-3;

bool is_rigid(const Eigen::Affine3d& T) {
  const Matrix3 R = T.linear();
  return T.matrix().allFinite() && (R * R.transpose()).isIdentity(kRigidTolerance) &&
         R.determinant() > 0.0;
}

}  // namespace

truth_t to_truth_record(const Trajectory& truth) {
  truth_t record = {};
  record.frame = truth.frame == PoseFrame::kLeft ? truth_t::FRAME_LEFT : truth_t::FRAME_BODY;
  record.key = truth.key == PoseKey::kRow ? truth_t::KEY_ROW : truth_t::KEY_STAMP;
  record.count = static_cast<std::int32_t>(truth.poses.size());
  record.poses.reserve(truth.poses.size());
  for (const TimedPose& pose : truth.poses) {
    record.keys.push_back(to_ns(pose.stamp));
    std::vector<double>& rows = record.poses.emplace_back(12);
    for (int i = 0; i < 12; ++i)
      rows[static_cast<std::size_t>(i)] = pose.T_world_pose(i / 4, i % 4);
  }
  return record;
}

std::optional<Trajectory> from_truth_record(const truth_t& record) {
  const bool is_left = record.frame == truth_t::FRAME_LEFT;
  const bool by_row = record.key == truth_t::KEY_ROW;
  if ((!is_left && record.frame != truth_t::FRAME_BODY) ||
      (!by_row && record.key != truth_t::KEY_STAMP)) {
    return std::nullopt;
  }
  Trajectory truth;
  truth.frame = is_left ? PoseFrame::kLeft : PoseFrame::kBody;
  truth.key = by_row ? PoseKey::kRow : PoseKey::kStamp;
  for (std::size_t k = 0; k < record.keys.size(); ++k) {
    TimedPose pose;
    pose.stamp = frame_time_from_ns(record.keys[k]);
    for (int i = 0; i < 12; ++i) {
      pose.T_world_pose(i / 4, i % 4) = record.poses[k][static_cast<std::size_t>(i)];
    }
    if (!is_rigid(pose.T_world_pose) || std::abs(record.keys[k]) > kMaxKey) return std::nullopt;
    truth.poses.push_back(pose);
  }
  return truth;
}

}  // namespace darkling
