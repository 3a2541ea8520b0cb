// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/output_file.h"
#include "app/sha256.h"
#include "io/evaluate.h"
#include "io/trajectory.h"
#include "vo/estimate.h"

namespace darkling {

struct OutputOptions {
  std::string trajectory_path;  // empty: not wanted
  TrajectoryFormat trajectory_format = TrajectoryFormat::kKitti;
  std::string stats_path;  // empty: not wanted
};

// What a run leaves behind: files that are opened before it and grow with it, the check sum of its
// trajectory, and the trajectory itself in the terms of the truth it will be compared with.
class RunOutputs {
 public:
  // @param frame, key  of the trajectory kept for comparison.
  // @param T_body_left  of the rig.
  // @return kUsage when a file cannot be written or both are the same.
  [[nodiscard]] static Result<RunOutputs> open(const OutputOptions& options, PoseFrame frame,
                                               PoseKey key, const Se3& T_body_left);

  // One input frame, bad ones included.
  void append(const Estimate& estimate);
  // Of the KITTI rows so far. @pre called once, after the last append().
  [[nodiscard]] std::string finish_sha256() { return kitti_rows_.finish(); }
  [[nodiscard]] Result<void> write_stats(const std::string& json);
  [[nodiscard]] Result<void> close();

  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }
  // Of the poses of trajectory(), one each.
  [[nodiscard]] std::span<const PoseUncertainty> uncertainties() const { return uncertainties_; }
  // Rows for the summary.
  [[nodiscard]] std::vector<std::string> describe() const;

 private:
  RunOutputs() = default;

  OutputOptions options_;
  std::optional<OutputFile> trajectory_file_;
  std::optional<OutputFile> stats_file_;
  Sha256 kitti_rows_;
  std::optional<Se3> T_first_world_;  // First: the left camera at the first frame
  Trajectory trajectory_;
  Se3 T_pose_body_;  // Pose: what the trajectory is of, Body or Left
  std::vector<PoseUncertainty> uncertainties_;
};

}  // namespace darkling
