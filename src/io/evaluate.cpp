// SPDX-License-Identifier: Apache-2.0
#include "io/evaluate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/SVD>

namespace darkling {

namespace {

constexpr std::array<double, 8> kLongLengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
constexpr std::array<double, 6> kShortLengths_m = {5, 10, 20, 30, 40, 50};

using Pairs = std::vector<PosePair>;

// Error of a motion: how far off, and turned by how much.
struct MotionError {
  double distance_m = 0.0;
  double angle_deg = 0.0;
};

// arctan2 of sine and cosine: the arccosine of the trace has half the digits at small angles.
double angle_deg(const Matrix3& R) {
  const Vector3 twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double angle_rad = std::atan2(0.5 * twice_sine.norm(), 0.5 * (R.trace() - 1.0));
  return angle_rad * 180.0 / std::numbers::pi;
}

// Of the estimated motion from pair a to pair b against the true one.
MotionError motion_error(const PosePair& a, const PosePair& b) {
  const Eigen::Affine3d T_a_b_estimate = a.estimate.inverse() * b.estimate;
  const Eigen::Affine3d T_a_b_truth = a.truth.inverse() * b.truth;
  const Eigen::Affine3d error = T_a_b_estimate.inverse() * T_a_b_truth;
  return {.distance_m = error.translation().norm(), .angle_deg = angle_deg(error.linear())};
}

// Length of the true path from the first pair to each.
std::vector<double> path_lengths(const Pairs& pairs) {
  std::vector<double> length_m = {0.0};
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double step_m = (pairs[i].truth.translation() - pairs[i - 1].truth.translation()).norm();
    length_m.push_back(length_m.back() + step_m);
  }
  return length_m;
}

// Geiger, Lenz, Urtasun 2012: the odometry benchmark's metric, here from every frame.
void evaluate_drift(const Pairs& pairs, const std::vector<double>& length_m,
                    Evaluation& evaluation) {
  const std::span<const double> lengths = length_m.back() >= kLongLengths_m.front()
                                              ? std::span<const double>(kLongLengths_m)
                                              : std::span<const double>(kShortLengths_m);
  double distance_sum = 0.0;  // m per m
  double angle_sum = 0.0;     // deg per m
  int count = 0;
  for (const double length : lengths) {
    for (std::size_t first = 0; first < pairs.size(); ++first) {
      const auto last =
          std::lower_bound(length_m.begin(), length_m.end(), length_m[first] + length);
      if (last == length_m.end()) break;
      const MotionError error = motion_error(pairs[first], pairs[last - length_m.begin()]);
      distance_sum += error.distance_m / length;
      angle_sum += error.angle_deg / length;
      ++count;
    }
  }
  if (count == 0) return;
  evaluation.drift_percent = 100.0 * distance_sum / count;
  evaluation.drift_deg_per_m = angle_sum / count;
}

void evaluate_steps(const Pairs& pairs, Evaluation& evaluation) {
  double distance_sum = 0.0;  // m²
  double angle_sum = 0.0;     // deg²
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const MotionError error = motion_error(pairs[i - 1], pairs[i]);
    distance_sum += error.distance_m * error.distance_m;
    angle_sum += error.angle_deg * error.angle_deg;
  }
  const auto count = static_cast<double>(pairs.size() - 1);
  evaluation.rpe_rmse_m = std::sqrt(distance_sum / count);
  evaluation.rpe_rmse_deg = std::sqrt(angle_sum / count);
}

// RMS distance of positions after the rigid alignment that makes it least.
// Umeyama 1991, eq. (40), without scale.
double absolute_error_m(const Pairs& pairs) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd truth(3, count);
  Eigen::Matrix3Xd estimate(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    truth.col(i) = pairs[i].truth.translation();
    estimate.col(i) = pairs[i].estimate.translation();
  }
  truth.colwise() -= Vector3(truth.rowwise().mean());
  estimate.colwise() -= Vector3(estimate.rowwise().mean());

  const Matrix3 covariance = truth * estimate.transpose();
  const Eigen::JacobiSVD<Matrix3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs = Vector3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  const Matrix3 R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return std::sqrt((R * estimate - truth).squaredNorm() / static_cast<double>(count));
}

Se3 se3(const Eigen::Affine3d& T) {
  return Se3(T.rotation(), T.translation());
}

// Adds the error ξ of the estimated motion from pair a to pair b: T_estimate = T_truth exp(ξ).
void add_error(const PosePair& a, const PosePair& b, const Matrix6& covariance,
               const TruthNoise& noise, NeesMean& nees) {
  const Se3 T_a_b_truth = se3(a.truth.inverse() * b.truth);
  const Vector6 xi = minus(se3(a.estimate.inverse() * b.estimate), T_a_b_truth);
  nees.add(xi, covariance + truth_covariance(noise, T_a_b_truth, b.index - a.index));
}

// The motions that were published as sure, against the true ones.
Confidence evaluate_confidence(const Pairs& pairs, std::span<const PoseUncertainty> uncertainties,
                               const TruthNoise& noise) {
  ConfidenceCount count;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const PoseUncertainty& at = uncertainties[pairs[i].index];
    if (!at.confident_motion || pairs[i].index != pairs[i - 1].index + 1) continue;
    const Se3 T_a_b_truth = se3(pairs[i - 1].truth.inverse() * pairs[i].truth);
    count.add(pairs[i].index, minus(*at.confident_motion, T_a_b_truth),
              at.cov_motion + truth_covariance(noise, T_a_b_truth, 1),
              T_a_b_truth.translation().norm());
  }
  return count.counts();
}

void evaluate_consistency(const Pairs& pairs, std::span<const PoseUncertainty> uncertainties,
                          const TruthNoise& noise, Evaluation& evaluation) {
  NeesMean motion;
  NeesMean pose;
  std::size_t start = 0;  // of the path without a reset
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const PoseUncertainty& at = uncertainties[pairs[i].index];
    if (pairs[i].index == pairs[i - 1].index + 1) {
      add_error(pairs[i - 1], pairs[i], at.cov_motion, noise, motion);
    }
    if (at.reset_counter != uncertainties[pairs[start].index].reset_counter) start = i;
    if (i > start) add_error(pairs[start], pairs[i], at.cov_pose, noise, pose);
  }
  evaluation.nees_motion = motion.mean();
  evaluation.nees_pose = pose.mean();
}

}  // namespace

Result<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate) {
  return evaluate(truth, estimate, {});
}

Result<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate,
                            std::span<const PoseUncertainty> uncertainties,
                            const TruthNoise& truth_noise) {
  const auto pairs = match_poses(truth, estimate);
  if (!pairs) return tl::unexpected(pairs.error());
  const std::vector<double> length_m = path_lengths(*pairs);

  Evaluation evaluation;
  evaluation.matched_poses = static_cast<int>(pairs->size());
  evaluation.path_m = length_m.back();
  evaluate_drift(*pairs, length_m, evaluation);
  evaluate_steps(*pairs, evaluation);
  evaluation.ate_rmse_m = absolute_error_m(*pairs);
  const MotionError end = motion_error(pairs->front(), pairs->back());
  evaluation.end_error_m = end.distance_m;
  evaluation.end_error_deg = end.angle_deg;
  if (!uncertainties.empty()) {
    evaluate_consistency(*pairs, uncertainties, truth_noise, evaluation);
    evaluation.confidence = evaluate_confidence(*pairs, uncertainties, truth_noise);
  }
  return evaluation;
}

}  // namespace darkling
