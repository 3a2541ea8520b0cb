// SPDX-License-Identifier: Apache-2.0
// How far an estimated trajectory is from the true one. Neither needs to start at the same pose:
// drift and RPE compare motions, ATE aligns first.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "io/confidence.h"
#include "io/nees.h"
#include "io/trajectory.h"

namespace darkling {

// Of one pose of a trajectory: right perturbations, as in vo/estimate.h, of its own frame.
struct PoseUncertainty {
  Matrix6 cov_motion;     // since the pose before
  Matrix6 cov_pose;       // since the last reset
  int reset_counter = 0;  // poses of different counts have nothing to do with each other
  // The motion since the pose before as it was published, where that was confident: poses move
  // with refinements besides.
  std::optional<Se3> confident_motion = {};
};

struct Evaluation {
  int matched_poses = 0;
  double path_m = 0.0;  // length of the true path through the matched poses
  // KITTI odometry metric: mean over all start frames and all lengths of the error of the motion
  // over that length, per length. Lengths are 100, 200 … 800 m where the path is at least 100 m,
  // else 5, 10, 20 … 50 m as far as they fit; nothing where not even 5 m fit.
  std::optional<double> drift_percent;
  std::optional<double> drift_deg_per_m;
  double ate_rmse_m = 0.0;  // distance of positions after the best rigid alignment
  double rpe_rmse_m = 0.0;  // error of the motion between consecutive matched poses
  double rpe_rmse_deg = 0.0;
  double end_error_m = 0.0;  // error of the motion from the first to the last matched pose
  double end_error_deg = 0.0;
  std::optional<Nees> nees_motion = {};  // between consecutive poses that both have a match
  std::optional<Nees> nees_pose =
      {};  // since the first pose with a match, or the first after a reset
  std::optional<Confidence> confidence = {};  // of the published motions
};

// Rows are matched by number, stamps to the nearest truth within 5 ms.
// @return kBadInput when the keys or frames of the two differ, or when fewer than three poses
// match:
//         the message gives both ranges.
[[nodiscard]] Result<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate);

// The same with NEES and confidence.
// @param uncertainties  of the poses of `estimate`, one each; or none, for neither.
[[nodiscard]] Result<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate,
                                          std::span<const PoseUncertainty> uncertainties,
                                          const TruthNoise& truth_noise = {});

// A true and an estimated pose of the same moment.
struct PosePair {
  Eigen::Affine3d truth = Eigen::Affine3d::Identity();
  Eigen::Affine3d estimate = Eigen::Affine3d::Identity();
  std::size_t index = 0;  // of the estimate
};

// The first half of evaluate().
[[nodiscard]] Result<std::vector<PosePair>> match_poses(const Trajectory& truth,
                                                        const Trajectory& estimate);

}  // namespace darkling
