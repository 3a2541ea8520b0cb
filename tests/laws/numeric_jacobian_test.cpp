// SPDX-License-Identifier: Apache-2.0
#include "support/numeric_jacobian.h"

#include <cmath>

#include <gtest/gtest.h>

namespace darkling::test {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

Eigen::Vector2d curved(const Eigen::Vector3d& x) {
  return {std::sin(x[0]) * x[1], std::exp(x[2]) + x[0] * x[0]};
}

Matrix23 curved_jacobian(const Eigen::Vector3d& x) {
  Matrix23 J;
  J << std::cos(x[0]) * x[1], std::sin(x[0]), 0.0,  //
      2.0 * x[0], 0.0, std::exp(x[2]);
  return J;
}

const Eigen::Vector3d kPoint(0.7, -1.3, 0.4);

TEST(NumericJacobian, AgreesWithAKnownDerivative) {
  const Matrix23 J = numeric_jacobian<2, 3>(curved, kPoint);
  EXPECT_LT(jacobian_error(J, curved_jacobian(kPoint)), 1e-10);
}

TEST(NumericJacobian, DisagreesWithADerivativeThatIsSlightlyWrong) {
  Matrix23 wrong = curved_jacobian(kPoint);
  wrong(0, 1) += 1e-6;
  EXPECT_GT(jacobian_error(wrong, numeric_jacobian<2, 3>(curved, kPoint)), 1e-7);
}

TEST(JacobianError, IsRelativeToLargeDerivatives) {
  const Eigen::Matrix2d large = Eigen::Matrix2d::Constant(1e6);
  EXPECT_DOUBLE_EQ(jacobian_error(Eigen::Matrix2d(large.array() + 1.0), large), 1e-6);
}

TEST(JacobianError, IsInfiniteForNumbersThatAreNone) {
  const Eigen::Matrix2d none = Eigen::Matrix2d::Constant(std::nan(""));
  EXPECT_TRUE(std::isinf(jacobian_error(none, Eigen::Matrix2d::Zero())));
}

}  // namespace
}  // namespace darkling::test
