// SPDX-License-Identifier: Apache-2.0
// The laws of a Lie group with right perturbations, as errors that ought to be rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/se3.h"
#include "support/numeric_jacobian.h"

namespace darkling::test {

// SO(3) and SE(3) seen through one pair of glasses.
struct So3Group {
  static constexpr int kDimension = 3;
  using Tangent = Vector3;
  using Square = Matrix3;
  using Element = Eigen::Quaterniond;

  static Vector3 rotation_part(const Tangent& xi) { return xi; }
  static Element exp(const Tangent& xi) { return so3_exp(xi); }
  static Tangent log(const Element& X) { return so3_log(X); }
  static Element inverse(const Element& X) { return X.conjugate(); }
  static Element compose(const Element& X, const Element& Y) { return X * Y; }
  static Vector3 act(const Element& X, const Vector3& p) { return X * p; }
  static Element plus(const Element& X, const Tangent& xi) { return X * so3_exp(xi); }
  static Tangent minus(const Element& Y, const Element& X) { return so3_log(X.conjugate() * Y); }
  static Square adjoint(const Element& X) { return X.toRotationMatrix(); }
  static Square right_jacobian(const Tangent& xi) { return so3_right_jacobian(xi); }
  static Square right_jacobian_inverse(const Tangent& xi) { return so3_right_jacobian_inverse(xi); }
  static Eigen::Matrix4d matrix(const Element& X) { return Se3(X, Vector3::Zero()).matrix(); }
  // The tangent as a matrix, hat(ξ), and the adjoint of the algebra, ad(ξ) η = [ξ, η].
  static Eigen::Matrix4d hat(const Tangent& xi) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M.topLeftCorner<3, 3>() = skew(xi);
    return M;
  }
  static Square ad(const Tangent& xi) { return skew(xi); }
};

struct Se3Group {
  static constexpr int kDimension = 6;
  using Tangent = Vector6;
  using Square = Matrix6;
  using Element = Se3;

  static Vector3 rotation_part(const Tangent& xi) { return xi.tail<3>(); }
  static Element exp(const Tangent& xi) { return Se3::exp(xi); }
  static Tangent log(const Element& X) { return X.log(); }
  static Element inverse(const Element& X) { return X.inverse(); }
  static Element compose(const Element& X, const Element& Y) { return X * Y; }
  static Vector3 act(const Element& X, const Vector3& p) { return X * p; }
  static Element plus(const Element& X, const Tangent& xi) { return darkling::plus(X, xi); }
  static Tangent minus(const Element& Y, const Element& X) { return darkling::minus(Y, X); }
  static Square adjoint(const Element& X) { return X.adjoint(); }
  static Square right_jacobian(const Tangent& xi) { return Se3::right_jacobian(xi); }
  static Square right_jacobian_inverse(const Tangent& xi) {
    return Se3::right_jacobian_inverse(xi);
  }
  static Eigen::Matrix4d matrix(const Element& X) { return X.matrix(); }
  static Eigen::Matrix4d hat(const Tangent& xi) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M.topLeftCorner<3, 3>() = skew(xi.tail<3>());
    M.topRightCorner<3, 1>() = xi.head<3>();
    return M;
  }
  static Square ad(const Tangent& xi) {
    Square A = Square::Zero();
    A.topLeftCorner<3, 3>() = skew(xi.tail<3>());
    A.topRightCorner<3, 3>() = skew(xi.head<3>());
    A.bottomRightCorner<3, 3>() = skew(xi.tail<3>());
    return A;
  }
};

// Σ A^n / (n + offset)! from n = 0: the exponential (offset 0) and the left Jacobian (offset 1) by
// their definition, in long double. Terms fall below rounding well before the last for |A| < 20.
template <class Square>
[[nodiscard]] Square exponential_series(const Square& A, int offset) {
  using Long = Eigen::Matrix<long double, Square::RowsAtCompileTime, Square::ColsAtCompileTime>;
  const Long A_long = A.template cast<long double>();
  Long term = Long::Identity();
  Long sum = term;
  for (int n = 1; n < 100; ++n) {
    term = (term * A_long / static_cast<long double>(n + offset)).eval();
    sum += term;
  }
  return sum.template cast<double>();
}

template <class A, class B>
[[nodiscard]] double difference(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  const double error = (a - b).cwiseAbs().maxCoeff();
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

// How far each law is from holding.
struct LieLawErrors {
  double exp_is_series = 0.0;              // exp(ξ) = Σ hat(ξ)^n / n!
  double exp_undoes_log = 0.0;             // exp(log(exp(ξ))) = exp(ξ)
  double log_undoes_exp = 0.0;             // log(exp(ξ)) = ξ; not asked for at |θ| = π
  double inverse = 0.0;                    // X X⁻¹ = X⁻¹ X = 1
  double inverse_is_exp_of_minus = 0.0;    // exp(-ξ) = exp(ξ)⁻¹
  double associativity = 0.0;              // (X Y) Z = X (Y Z)
  double action = 0.0;                     // (X Y) p = X (Y p), and as the matrix does
  double adjoint = 0.0;                    // X exp(ξ) X⁻¹ = exp(Ad_X ξ)
  double adjoint_of_product = 0.0;         // Ad_XY = Ad_X Ad_Y
  double right_jacobian_is_series = 0.0;   // J_r(ξ) = Σ (-ad ξ)^n / (n + 1)!
  double right_jacobian_is_numeric = 0.0;  // exp(ξ + δ) ≈ exp(ξ) exp(J_r δ)
  double right_jacobian_inverse = 0.0;     // J_r⁻¹ J_r = 1
  double minus_undoes_plus = 0.0;          // (X ⊞ ξ) ⊟ X = ξ; not asked for at |θ| = π
};

// Every law, to go over them in a loop.
inline constexpr double LieLawErrors::*kLieLaws[] = {
    &LieLawErrors::exp_is_series,
    &LieLawErrors::exp_undoes_log,
    &LieLawErrors::log_undoes_exp,
    &LieLawErrors::inverse,
    &LieLawErrors::inverse_is_exp_of_minus,
    &LieLawErrors::associativity,
    &LieLawErrors::action,
    &LieLawErrors::adjoint,
    &LieLawErrors::adjoint_of_product,
    &LieLawErrors::right_jacobian_is_series,
    &LieLawErrors::right_jacobian_is_numeric,
    &LieLawErrors::right_jacobian_inverse,
    &LieLawErrors::minus_undoes_plus,
};

// Checks every law at ξ = `a`, with the further elements exp(b) and exp(c).
template <class Group>
[[nodiscard]] LieLawErrors lie_law_errors(const typename Group::Tangent& a,
                                          const typename Group::Tangent& b,
                                          const typename Group::Tangent& c) {
  using Tangent = typename Group::Tangent;
  using Square = typename Group::Square;
  constexpr int kDimension = Group::kDimension;
  const auto X = Group::exp(a);
  const auto Y = Group::exp(b);
  const auto Z = Group::exp(c);
  const auto M = [](const auto& element) { return Group::matrix(element); };
  const auto X_inverse = Group::inverse(X);
  const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
  const Vector3 p(0.3, -0.7, 1.9);
  // Rounding decides which of ξ and -ξ comes back where the rotation is by π.
  const bool is_half_turn = Group::rotation_part(a).norm() > 3.14159265;
  const Square J = Group::right_jacobian(a);

  LieLawErrors errors;
  errors.exp_is_series = difference(M(X), exponential_series(Group::hat(a), 0));
  errors.exp_undoes_log = difference(M(Group::exp(Group::log(X))), M(X));
  if (!is_half_turn) errors.log_undoes_exp = difference(Group::log(X), a);
  errors.inverse = std::max(difference(M(Group::compose(X, X_inverse)), one),
                            difference(M(Group::compose(X_inverse, X)), one));
  errors.inverse_is_exp_of_minus = difference(M(Group::exp(Tangent(-a))), M(X_inverse));
  errors.associativity = difference(M(Group::compose(Group::compose(X, Y), Z)),
                                    M(Group::compose(X, Group::compose(Y, Z))));
  const Vector3 acted = Group::act(Group::compose(X, Y), p);
  errors.action = std::max(difference(acted, Group::act(X, Group::act(Y, p))),
                           difference(acted, (M(X) * M(Y) * p.homogeneous()).template head<3>()));
  const auto conjugated = Group::compose(Group::compose(Y, X), Group::inverse(Y));
  errors.adjoint = difference(M(conjugated), M(Group::exp(Tangent(Group::adjoint(Y) * a))));
  errors.adjoint_of_product =
      difference(Group::adjoint(Group::compose(X, Y)), Group::adjoint(X) * Group::adjoint(Y));
  errors.right_jacobian_is_series = difference(J, exponential_series(Square(-Group::ad(a)), 1));
  const auto moved = [&](const Tangent& delta) -> Tangent {
    return Group::log(Group::compose(X_inverse, Group::exp(Tangent(a + delta))));
  };
  errors.right_jacobian_is_numeric =
      jacobian_error(J, numeric_jacobian<kDimension, kDimension>(moved, Tangent(Tangent::Zero())));
  errors.right_jacobian_inverse =
      difference(Group::right_jacobian_inverse(a) * J, Square::Identity());
  if (!is_half_turn) {
    errors.minus_undoes_plus = difference(Group::minus(Group::plus(Y, a), Y), a);
  }
  return errors;
}

}  // namespace darkling::test
