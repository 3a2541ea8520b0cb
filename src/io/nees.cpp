// SPDX-License-Identifier: Apache-2.0
#include "io/nees.h"

#include <numbers>

#include <Eigen/Cholesky>

#include "vo/covariance.h"

namespace darkling {

namespace {

// Of chi-squared with six degrees of freedom, at the probability of three sigmas in one dimension.
constexpr double kSquareOfThreeSigmas = 20.06;

}  // namespace

void NeesMean::add(const Vector6& xi, const Matrix6& covariance) {
  if (!is_known(covariance)) return;
  const Eigen::LLT<Matrix6> cholesky(covariance);
  if (cholesky.info() != Eigen::Success) return;
  const double square = xi.dot(cholesky.solve(xi));
  const auto square_of = [&](Eigen::Index first) {
    const Vector3 part = xi.segment<3>(first);
    const Matrix3 block = covariance.block<3, 3>(first, first);
    return part.dot(block.llt().solve(part));
  };
  ++sums_.count;
  sums_.mean += square;
  sums_.translation += square_of(0);
  sums_.rotation += square_of(3);
  if (square > kSquareOfThreeSigmas) sums_.share_beyond += 1.0;
}

std::optional<Nees> NeesMean::mean() const {
  if (sums_.count == 0) return std::nullopt;
  const double n = sums_.count;
  return Nees{.count = sums_.count,
              .mean = sums_.mean / (6.0 * n),
              .translation = sums_.translation / (3.0 * n),
              .rotation = sums_.rotation / (3.0 * n),
              .share_beyond = sums_.share_beyond / n};
}

Matrix6 truth_covariance(const TruthNoise& noise, const Se3& T_a_b, std::size_t frames) {
  const double m = noise.share * T_a_b.translation().norm();
  const double turned = noise.share * rotation_angle(T_a_b);
  const double besides = noise.angle_deg * std::numbers::pi / 180.0;
  Vector6 variances;
  variances << Vector3::Constant(m * m),
      Vector3::Constant(turned * turned + static_cast<double>(frames) * besides * besides);
  return variances.asDiagonal();
}

}  // namespace darkling
