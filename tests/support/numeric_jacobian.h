// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

namespace darkling::test {

// The derivative of `f`: R^N → R^M at `x` from central differences at two steps, extrapolated so
// that the error falls with the fourth power of `step`: about 1e-10 relative for smooth functions
// of magnitude one with the step that is given.
template <int M, int N, class Function>
[[nodiscard]] Eigen::Matrix<double, M, N> numeric_jacobian(const Function& f,
                                                           const Eigen::Matrix<double, N, 1>& x,
                                                           double step = 1e-3) {
  using Vector = Eigen::Matrix<double, N, 1>;
  Eigen::Matrix<double, M, N> J;
  for (int i = 0; i < N; ++i) {
    const auto slope = [&](double h) -> Eigen::Matrix<double, M, 1> {
      const Vector dx = h * Vector::Unit(i);
      const Eigen::Matrix<double, M, 1> ahead = f(Vector(x + dx));
      const Eigen::Matrix<double, M, 1> behind = f(Vector(x - dx));
      return (ahead - behind) / (2.0 * h);
    };
    J.col(i) = (4.0 * slope(0.5 * step) - slope(step)) / 3.0;
  }
  return J;
}

// The greatest difference of two Jacobians, relative to the greater of 1 and what is expected.
template <class A, class B>
[[nodiscard]] double jacobian_error(const Eigen::MatrixBase<A>& J,
                                    const Eigen::MatrixBase<B>& expected) {
  const double scale = std::max(1.0, expected.cwiseAbs().maxCoeff());
  const double error = (J - expected).cwiseAbs().maxCoeff() / scale;
  return J.allFinite() && expected.allFinite() ? error : std::numeric_limits<double>::infinity();
}

}  // namespace darkling::test
