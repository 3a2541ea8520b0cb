// SPDX-License-Identifier: Apache-2.0
#include "app/run_outputs.h"

#include "vo/covariance.h"

namespace darkling {

namespace {

Result<void> open_if_named(const std::string& path, std::optional<OutputFile>& file) {
  if (path.empty()) return {};
  auto opened = OutputFile::open(path);
  if (!opened) return tl::unexpected(opened.error());
  file = std::move(*opened);
  return {};
}

Result<void> close_if_open(std::optional<OutputFile>& file) {
  if (!file) return {};
  const auto closed = file->close();
  file.reset();
  return closed;
}

}  // namespace

Result<RunOutputs> RunOutputs::open(const OutputOptions& options, PoseFrame frame, PoseKey key,
                                    const Se3& T_body_left) {
  if (!options.stats_path.empty() && options.stats_path == options.trajectory_path) {
    return failure(ExitCode::kUsage,
                   options.stats_path + ": is named by both --trajectory and " + "--stats");
  }
  RunOutputs outputs;
  outputs.options_ = options;
  outputs.trajectory_.frame = frame;
  outputs.trajectory_.key = key;
  outputs.T_pose_body_ = frame == PoseFrame::kLeft ? T_body_left.inverse() : Se3();
  if (auto opened = open_if_named(options.trajectory_path, outputs.trajectory_file_); !opened) {
    return tl::unexpected(opened.error());
  }
  if (auto opened = open_if_named(options.stats_path, outputs.stats_file_); !opened) {
    return tl::unexpected(opened.error());
  }
  return outputs;
}

void RunOutputs::append(const Estimate& estimate) {
  // T · T⁻¹ is the identity only to within rounding; the first pose is it exactly.
  const bool is_first = !T_first_world_.has_value();
  if (is_first) T_first_world_ = estimate.T_world_left.inverse();
  const Se3 T_first_left = is_first ? Se3() : *T_first_world_ * estimate.T_world_left;

  const std::string kitti_row = format_kitti_row(T_first_left);
  kitti_rows_.append(kitti_row);
  if (trajectory_file_) {
    trajectory_file_->append(options_.trajectory_format == TrajectoryFormat::kKitti
                                 ? kitti_row
                                 : format_tum_row(estimate.stamp, estimate.T_world_body));
  }
  const bool by_row = trajectory_.key == PoseKey::kRow;
  const bool of_left = trajectory_.frame == PoseFrame::kLeft;
  trajectory_.poses.push_back(
      {.stamp = by_row ? frame_time_from_ns(estimate.sequence) : estimate.stamp,
       .T_world_pose = to_affine(of_left ? T_first_left : estimate.T_world_body)});
  std::optional<Se3> confident_motion;
  if (is_confident(estimate)) {
    confident_motion = T_pose_body_ * estimate.T_previous_body * T_pose_body_.inverse();
  }
  uncertainties_.push_back(
      {.cov_motion = transport_covariance(estimate.cov_previous_body, T_pose_body_),
       .cov_pose = transport_covariance(estimate.cov_world_body, T_pose_body_),
       .reset_counter = estimate.reset_counter,
       .confident_motion = confident_motion});
}

Result<void> RunOutputs::write_stats(const std::string& json) {
  if (stats_file_) stats_file_->append(json);
  return close_if_open(stats_file_);
}

Result<void> RunOutputs::close() {
  return close_if_open(trajectory_file_);
}

std::vector<std::string> RunOutputs::describe() const {
  std::vector<std::string> rows;
  if (!options_.trajectory_path.empty()) {
    const bool is_kitti = options_.trajectory_format == TrajectoryFormat::kKitti;
    rows.push_back("trajectory  " + options_.trajectory_path +
                   (is_kitti ? " (KITTI, left camera)" : " (TUM, body)"));
  }
  if (!options_.stats_path.empty()) rows.push_back("statistics  " + options_.stats_path);
  return rows;
}

}  // namespace darkling
