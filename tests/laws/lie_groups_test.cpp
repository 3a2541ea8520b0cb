// SPDX-License-Identifier: Apache-2.0
#include <numbers>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "support/lie_laws.h"
#include "support/random.h"

namespace darkling::test {
namespace {

// Angles (rad) where a formula may change its form, or lose digits.
std::vector<double> telling_angles() {
  std::vector<double> angles = {0.0, 1e-160, 1e-12, 1e-8, 1e-5, 1e-3, 1.0, 2.0, 3.0};
  for (const double seam : {1e-2, 0.05, 0.15}) {  // where se3.cpp turns from series to closed forms
    for (const double way : {-1e-3, -1e-12, 0.0, 1e-12, 1e-3}) angles.push_back(seam * (1.0 + way));
  }
  constexpr double kPi = std::numbers::pi;
  for (const double gap : {1e-2, 1e-4, 1e-6, 1e-8, 0.0}) angles.push_back(kPi - gap);
  return angles;
}

template <class Group>
typename Group::Tangent tangent(Random& random, double angle_rad) {
  typename Group::Tangent xi;
  xi.setZero();
  xi.template tail<3>() = angle_rad * random.direction();
  if constexpr (Group::kDimension == 6) xi.template head<3>() = random.vector<3>(3.0);
  return xi;
}

template <class Group>
std::vector<typename Group::Tangent> telling_tangents() {
  Random random(1);
  std::vector<typename Group::Tangent> tangents = {Group::Tangent::Zero()};
  for (const double angle_rad : telling_angles()) {
    for (int i = 0; i < 5; ++i) tangents.push_back(tangent<Group>(random, angle_rad));
    tangents.push_back(tangents.back().cwiseAbs().maxCoeff() > 0.0
                           ? typename Group::Tangent(1e-8 * tangents.back())
                           : tangents.back());
  }
  for (int i = 0; i < 300; ++i) {
    tangents.push_back(tangent<Group>(random, random.uniform(0.0, std::numbers::pi)));
  }
  return tangents;
}

template <class Group>
class LieGroup : public testing::Test {
 protected:
  // Runs every law over every telling tangent and keeps the greatest errors.
  static LieLawErrors greatest_errors() {
    Random random(2);
    LieLawErrors greatest;
    for (const auto& xi : telling_tangents<Group>()) {
      const auto b = tangent<Group>(random, random.uniform(0.0, 3.0));
      const auto c = tangent<Group>(random, random.uniform(0.0, 3.0));
      const LieLawErrors errors = lie_law_errors<Group>(xi, b, c);
      for (const auto law : kLieLaws) greatest.*law = std::max(greatest.*law, errors.*law);
    }
    return greatest;
  }
};

using Groups = testing::Types<So3Group, Se3Group>;
TYPED_TEST_SUITE(LieGroup, Groups);

// Elements reach 10 in size: rounding alone leaves up to 4e-14, in the closed form of Q of the
// Jacobian just above its seam.
constexpr double kRounding = 2e-13;

TYPED_TEST(LieGroup, KeepsEveryLawToRounding) {
  const LieLawErrors errors = this->greatest_errors();
  EXPECT_LT(errors.exp_is_series, kRounding);
  EXPECT_LT(errors.exp_undoes_log, kRounding);
  EXPECT_LT(errors.log_undoes_exp, kRounding);
  EXPECT_LT(errors.inverse, kRounding);
  EXPECT_LT(errors.inverse_is_exp_of_minus, kRounding);
  EXPECT_LT(errors.associativity, kRounding);
  EXPECT_LT(errors.action, kRounding);
  EXPECT_LT(errors.adjoint, kRounding);
  EXPECT_LT(errors.adjoint_of_product, kRounding);
  EXPECT_LT(errors.right_jacobian_is_series, kRounding);
  EXPECT_LT(errors.right_jacobian_is_numeric, 1e-10);
  EXPECT_LT(errors.right_jacobian_inverse, kRounding);
  EXPECT_LT(errors.minus_undoes_plus, kRounding);
}

TYPED_TEST(LieGroup, HasTheZeroTangentAtItsIdentity) {
  using Group = TypeParam;
  const typename Group::Tangent zero = Group::Tangent::Zero();
  EXPECT_EQ(Group::matrix(Group::exp(zero)), Eigen::Matrix4d::Identity());
  EXPECT_EQ(Group::log(Group::exp(zero)), zero);
  EXPECT_EQ(Group::right_jacobian(zero), Group::Square::Identity());
  EXPECT_EQ(Group::right_jacobian_inverse(zero), Group::Square::Identity());
}

TEST(So3Log, GoesTheShorterWayRound) {
  const Vector3 axis = Vector3(1.0, 2.0, -2.0) / 3.0;
  const Vector3 theta = so3_log(so3_exp(1.5 * std::numbers::pi * axis));
  EXPECT_LT((theta + 0.5 * std::numbers::pi * axis).norm(), 1e-14);
}

TEST(So3Log, IsTheSameForBothSignsOfTheQuaternion) {
  const Eigen::Quaterniond q = so3_exp({0.1, -0.2, 0.3});
  const Eigen::Quaterniond minus_q(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_EQ(so3_log(q), so3_log(minus_q));
}

TEST(So3Log, OfAHalfTurnIsPiAlongTheAxis) {
  EXPECT_DOUBLE_EQ(so3_log(Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0)).norm(), std::numbers::pi);
  EXPECT_DOUBLE_EQ(so3_log(Eigen::Quaterniond(-0.0, 0.0, 1.0, 0.0)).norm(), std::numbers::pi);
}

TEST(Se3, StaysARotationOverManyProducts) {
  const Se3 step = Se3::exp((Vector6() << 0.1, 0.2, 0.3, 0.01, -0.02, 0.03).finished());
  Se3 T;
  for (int i = 0; i < 100'000; ++i) T = T * step;
  EXPECT_LT((T.R() * T.R().transpose() - Matrix3::Identity()).norm(), 1e-14);
}

TEST(RotationAngle, IsTheLengthOfTheRotationVector) {
  const Se3 T = Se3::exp((Vector6() << 1, 2, 3, 0.3, 0.0, 0.4).finished());
  EXPECT_NEAR(rotation_angle(T), 0.5, 1e-15);
}

}  // namespace
}  // namespace darkling::test
