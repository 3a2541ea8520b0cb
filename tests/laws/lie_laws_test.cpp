// SPDX-License-Identifier: Apache-2.0
// The law checker catches groups that break a law, each in one way.
#include "support/lie_laws.h"

#include <limits>

#include <gtest/gtest.h>

namespace darkling::test {
namespace {

template <class Group>
LieLawErrors errors_of() {
  return lie_law_errors<Group>({0.4, -0.3, 0.2}, {-0.1, 0.5, 0.3}, {0.7, 0.1, -0.6});
}

constexpr double kPlain = 1e-2;  // a broken law is off by far more than rounding
constexpr double kKept = 1e-10;

TEST(LieLaws, FindNothingInAGroupThatKeepsThem) {
  const LieLawErrors errors = errors_of<So3Group>();
  for (const auto law : kLieLaws) EXPECT_LT(errors.*law, kKept);
}

struct DoubledExp : So3Group {
  static Element exp(const Tangent& xi) { return so3_exp(2.0 * xi); }
};
TEST(LieLaws, FindAnExponentialThatIsNotTheSeries) {
  EXPECT_GT(errors_of<DoubledExp>().exp_is_series, kPlain);
}

struct NegatedLog : So3Group {
  static Tangent log(const Element& X) { return -so3_log(X); }
};
TEST(LieLaws, FindALogarithmOfTheWrongSign) {
  const LieLawErrors errors = errors_of<NegatedLog>();
  EXPECT_GT(errors.exp_undoes_log, kPlain);
  EXPECT_GT(errors.log_undoes_exp, kPlain);
}

struct NoInverse : So3Group {
  static Element inverse(const Element& X) { return X; }
};
TEST(LieLaws, FindAnInverseThatIsNone) {
  const LieLawErrors errors = errors_of<NoInverse>();
  EXPECT_GT(errors.inverse, kPlain);
  EXPECT_GT(errors.inverse_is_exp_of_minus, kPlain);
}

struct Division : So3Group {
  static Element compose(const Element& X, const Element& Y) { return X * Y.conjugate(); }
};
TEST(LieLaws, FindAProductThatDoesNotAssociate) {
  EXPECT_GT(errors_of<Division>().associativity, kPlain);
}

struct Passive : So3Group {
  static Vector3 act(const Element& X, const Vector3& p) { return X.conjugate() * p; }
};
TEST(LieLaws, FindAnActionTheOtherWayRound) {
  EXPECT_GT(errors_of<Passive>().action, kPlain);
}

struct TransposedAdjoint : So3Group {
  static Square adjoint(const Element& X) { return X.toRotationMatrix().transpose(); }
};
TEST(LieLaws, FindATransposedAdjoint) {
  const LieLawErrors errors = errors_of<TransposedAdjoint>();
  EXPECT_GT(errors.adjoint, kPlain);
  EXPECT_GT(errors.adjoint_of_product, kPlain);
}

struct LeftJacobian : So3Group {
  static Square right_jacobian(const Tangent& xi) { return so3_right_jacobian(-xi); }
};
TEST(LieLaws, FindALeftJacobianInPlaceOfTheRight) {
  const LieLawErrors errors = errors_of<LeftJacobian>();
  EXPECT_GT(errors.right_jacobian_is_series, kPlain);
  EXPECT_GT(errors.right_jacobian_is_numeric, kPlain);
  EXPECT_GT(errors.right_jacobian_inverse, kPlain);
}

struct LeftPlus : So3Group {
  static Element plus(const Element& X, const Tangent& xi) { return so3_exp(xi) * X; }
};
TEST(LieLaws, FindAPerturbationOnTheLeft) {
  const LieLawErrors errors = errors_of<LeftPlus>();
  EXPECT_GT(errors.minus_undoes_plus, kPlain);
  EXPECT_LT(errors.exp_undoes_log, kKept);  // and blame nothing else
}

struct NotANumber : So3Group {
  static Square right_jacobian_inverse(const Tangent&) {
    return Square::Constant(std::numeric_limits<double>::quiet_NaN());
  }
};
TEST(LieLaws, FindNumbersThatAreNone) {
  EXPECT_GT(errors_of<NotANumber>().right_jacobian_inverse, kPlain);
}

// What a product in se3.cpp gone wrong would look like: SE(3) without the coupling of translation
// and rotation in its Jacobian.
struct Uncoupled : Se3Group {
  static Square right_jacobian(const Tangent& xi) {
    Square J = Se3::right_jacobian(xi);
    J.topRightCorner<3, 3>().setZero();
    return J;
  }
};
TEST(LieLaws, FindAJacobianWithoutItsCoupling) {
  const Vector6 xi = (Vector6() << 1.0, 2.0, 3.0, 0.1, 0.2, 0.3).finished();
  const LieLawErrors errors = lie_law_errors<Uncoupled>(xi, 0.5 * xi, -xi);
  EXPECT_GT(errors.right_jacobian_is_series, kPlain);
  EXPECT_GT(errors.right_jacobian_is_numeric, kPlain);
}

}  // namespace
}  // namespace darkling::test
