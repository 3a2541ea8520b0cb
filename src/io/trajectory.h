// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "base/result.h"
#include "base/time.h"
#include "geometry/se3.h"

namespace darkling {

// The poses are T_world_left (rectified left camera) or T_world_body. What World is differs from
// file to file; comparisons do not depend on it.
enum class PoseFrame { kLeft, kBody };

// What `TimedPose::stamp` holds: a row number (KITTI: one row a frame of the source) or a time.
enum class PoseKey { kRow, kStamp };

struct TimedPose {
  FrameTime stamp;  // with PoseKey::kRow: the row, counted from 0, as so many nanoseconds
  // As written in the file: rotations of seven digits are not quite orthonormal, and a nearest
  // rotation in their place would move the figures of an evaluation in the sixth digit.
  Eigen::Affine3d T_world_pose = Eigen::Affine3d::Identity();
};

struct Trajectory {
  PoseFrame frame = PoseFrame::kLeft;
  PoseKey key = PoseKey::kRow;
  std::vector<TimedPose> poses;  // in the order of the file
};

[[nodiscard]] inline Eigen::Affine3d to_affine(const Se3& T) {
  return Eigen::Affine3d(T.matrix());
}

// Reads a KITTI file (12 numbers a row, T_world_left), a TUM file (stamp tx ty tz qx qy qz qw,
// T_world_body) or an EuRoC state_groundtruth_estimate0/data.csv (ns, p, q wxyz, …; T_world_body),
// recognised by their columns. Lines that start with # and empty lines are skipped.
// @return kNoInput when the file cannot be read; kBadInput with file and line when a row is
//         malformed, has another number of columns than the first, or is no rigid motion.
[[nodiscard]] Result<Trajectory> read_trajectory(const std::string& path);

enum class TrajectoryFormat { kTum, kKitti };

// One line with its newline, the same bytes on every machine and in every locale; every number
// reads back as the same double.
[[nodiscard]] std::string format_kitti_row(const Se3& T_world_left);
// @param stamp  written in seconds with all nine decimals.
[[nodiscard]] std::string format_tum_row(FrameTime stamp, const Se3& T_world_body);

}  // namespace darkling
