// SPDX-License-Identifier: Apache-2.0
#include "io/confidence.h"

#include <algorithm>
#include <numbers>

#include <Eigen/Cholesky>

#include "vo/covariance.h"

namespace darkling {

namespace {

constexpr int kLeastQuality = 50;
// Of chi-squared with three degrees of freedom, at the probability of three sigmas in one
// dimension.
constexpr double kSquareOfThreeSigmas = 14.16;
constexpr double kLargeShare = 0.05;  // of the true step
constexpr double kLargeFloor_m = 0.001;
constexpr double kLargeAngle_rad = 0.5 * std::numbers::pi / 180.0;

// @param first  0 for the translation, 3 for the rotation.
bool is_beyond_three_sigmas(const Vector6& xi, const Matrix6& covariance, Eigen::Index first) {
  const Vector3 part = xi.segment<3>(first);
  const Matrix3 block = covariance.block<3, 3>(first, first);
  const Eigen::LLT<Matrix3> cholesky(block);
  return cholesky.info() == Eigen::Success && part.dot(cholesky.solve(part)) > kSquareOfThreeSigmas;
}

}  // namespace

bool is_confident(const Estimate& estimate) {
  return estimate.status == TrackStatus::kValid && estimate.quality >= kLeastQuality;
}

void ConfidenceCount::add(std::size_t index, const Vector6& xi, const Matrix6& covariance,
                          double true_step_m) {
  ++counts_.frames;
  if (!is_known(covariance)) return;
  const double large_m = std::max(kLargeFloor_m, kLargeShare * true_step_m);
  const bool is_translation_wrong =
      xi.head<3>().norm() > large_m && is_beyond_three_sigmas(xi, covariance, 0);
  const bool is_rotation_wrong =
      xi.tail<3>().norm() > kLargeAngle_rad && is_beyond_three_sigmas(xi, covariance, 3);
  if (is_translation_wrong || is_rotation_wrong) counts_.wrong.push_back(index);
}

}  // namespace darkling
