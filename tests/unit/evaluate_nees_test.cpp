// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "io/evaluate.h"
#include "support/random_walk.h"
#include "vo/covariance.h"

namespace darkling {
namespace {

using test::rows_of;

// The error of a step of random_walk(): uniform in [-error, error), half as much in rotation.
Matrix6 covariance_of_step(double error) {
  Vector6 variances;
  variances << Vector3::Constant(error * error / 3.0), Vector3::Constant(error * error / 12.0);
  return variances.asDiagonal();
}

std::vector<PoseUncertainty> every_step(std::size_t count, const Matrix6& covariance) {
  return std::vector<PoseUncertainty>(
      count, {.cov_motion = covariance, .cov_pose = covariance, .reset_counter = 0});
}

Evaluation evaluated(const test::RandomWalk& walk, const std::vector<PoseUncertainty>& uncertain,
                     const TruthNoise& noise = {}) {
  const auto evaluation = evaluate(rows_of(walk.truth), rows_of(walk.estimate), uncertain, noise);
  EXPECT_TRUE(evaluation) << evaluation.error().message;
  return evaluation ? *evaluation : Evaluation{};
}

TEST(EvaluateNees, IsOneForHonestCovariancesAndFourForHalfTheSigma) {
  const auto walk = test::random_walk(5, 500, 0.5, 0.01);
  const Nees honest = *evaluated(walk, every_step(500, covariance_of_step(0.01))).nees_motion;
  EXPECT_EQ(honest.count, 499);
  EXPECT_NEAR(honest.mean, 1.0, 0.1);
  EXPECT_NEAR(honest.translation, 1.0, 0.1);
  EXPECT_NEAR(honest.rotation, 1.0, 0.1);
  EXPECT_EQ(honest.share_beyond, 0.0);  // uniform errors have no tails
  const Nees bold = *evaluated(walk, every_step(500, covariance_of_step(0.005))).nees_motion;
  EXPECT_NEAR(bold.mean, 4.0 * honest.mean, 1e-6);
  EXPECT_GT(bold.share_beyond, 0.5);
}

TEST(EvaluateNees, LeavesOutWhatIsNotKnown) {
  const auto walk = test::random_walk(6, 50, 0.5, 0.01);
  std::vector<PoseUncertainty> uncertain = every_step(50, covariance_of_step(0.01));
  for (std::size_t i = 10; i < 20; ++i) uncertain[i].cov_motion = unknown_covariance();
  EXPECT_EQ(evaluated(walk, uncertain).nees_motion->count, 39);
  const Evaluation none = evaluated(walk, every_step(50, unknown_covariance()));
  EXPECT_FALSE(none.nees_motion);
  EXPECT_FALSE(none.nees_pose);
  EXPECT_FALSE(evaluated(walk, {}).nees_motion);
  EXPECT_FALSE(evaluated(walk, every_step(50, Matrix6::Zero())).nees_pose);
}

TEST(EvaluateNees, TakesPosesFromWhereTheTrackStartedAnew) {
  // Before the reset all is exact; at it the path jumps; after it all is exact again.
  auto walk = test::random_walk(7, 20, 0.5, 0.0);
  std::vector<PoseUncertainty> uncertain = every_step(20, covariance_of_step(0.01));
  for (std::size_t i = 10; i < 20; ++i) {
    walk.estimate[i] = Se3(Eigen::Quaterniond::Identity(), Vector3(9, 0, 0)) * walk.estimate[i];
  }
  EXPECT_GT(evaluated(walk, uncertain).nees_pose->mean, 1e3);
  for (std::size_t i = 10; i < 20; ++i) uncertain[i].reset_counter = 1;
  const Nees pose = *evaluated(walk, uncertain).nees_pose;
  EXPECT_EQ(pose.count, 18);
  EXPECT_LT(pose.mean, 1e-9);
}

TEST(EvaluateNees, GivesTheTruthItsOwnNoise) {
  const auto walk = test::random_walk(8, 400, 0.5, 0.01);
  const std::vector<PoseUncertainty> uncertain = every_step(400, covariance_of_step(1e-6));
  EXPECT_GT(evaluated(walk, uncertain).nees_motion->mean, 1e4);
  // Steps of half a metre: 0.01 / √3 m is 1.15 % of it, and half as many radians are 0.165 deg.
  const Nees nees =
      *evaluated(walk, uncertain, {.share = 0.01155, .angle_deg = 0.1654}).nees_motion;
  EXPECT_NEAR(nees.translation, 1.0, 0.1);
  EXPECT_NEAR(nees.rotation, 1.0, 0.1);
}

TEST(TruthCovariance, GrowsWithTheMotionAndWithTheFramesItSpans) {
  const TruthNoise noise = {.share = 0.01, .angle_deg = 1.0};
  const Se3 T_a_b(so3_exp({0.2, 0, 0}), {3, 0, 4});
  const Matrix6 covariance = truth_covariance(noise, T_a_b, 4);
  const double besides = 4.0 * std::pow(3.14159265358979 / 180.0, 2);
  EXPECT_NEAR(covariance(1, 1), 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(covariance(4, 4), 0.002 * 0.002 + besides, 1e-12);
  EXPECT_EQ(truth_covariance({}, T_a_b, 4), Matrix6::Zero());
}

}  // namespace
}  // namespace darkling
