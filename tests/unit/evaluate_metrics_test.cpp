// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "io/evaluate.h"
#include "support/random_walk.h"

namespace darkling {
namespace {

using test::rows_of;

// `count` poses in a straight line, `step_m` apart.
std::vector<Se3> straight(int count, double step_m) {
  std::vector<Se3> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back({Eigen::Quaterniond::Identity(), Vector3(0, 0, i * step_m)});
  }
  return poses;
}

Evaluation evaluated(const std::vector<Se3>& truth, const std::vector<Se3>& estimate) {
  const auto evaluation = evaluate(rows_of(truth), rows_of(estimate));
  EXPECT_TRUE(evaluation) << evaluation.error().message;
  return evaluation ? *evaluation : Evaluation{};
}

TEST(Evaluate, FindsNoErrorInTheTruthSeenFromAnotherWorld) {
  const auto walk = test::random_walk(5, 100, 0.5, 0.0);
  const Evaluation e = evaluated(walk.truth, walk.estimate);
  EXPECT_EQ(e.matched_poses, 100);
  EXPECT_LT(e.drift_percent.value(), 1e-9);
  EXPECT_LT(e.drift_deg_per_m.value(), 1e-9);
  EXPECT_LT(e.ate_rmse_m, 1e-9);
  EXPECT_LT(e.rpe_rmse_m, 1e-9);
  EXPECT_LT(e.rpe_rmse_deg, 1e-9);
}

TEST(Evaluate, ReadsAScaleErrorAsDriftOfItsSize) {
  // 2 % long everywhere: every length is off by 2 % of the *true* motion between its ends.
  const Evaluation e = evaluated(straight(61, 1.0), straight(61, 1.02));
  EXPECT_NEAR(e.drift_percent.value(), 2.0, 1e-9);
  EXPECT_NEAR(e.drift_deg_per_m.value(), 0.0, 1e-9);
  EXPECT_NEAR(e.rpe_rmse_m, 0.02, 1e-12);
  EXPECT_NEAR(e.end_error_m, 1.2, 1e-12);
  // Positions -30 … 30 from the middle, each off by 2 %: 0.02 · sqrt((61² - 1) / 12).
  EXPECT_NEAR(e.ate_rmse_m, 0.02 * std::sqrt(310.0), 1e-12);
}

TEST(Evaluate, ReadsTurningOnTheSpotAsRotationError) {
  std::vector<Se3> estimate = straight(11, 1.0);
  const double turn_deg = 0.5;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const double angle = static_cast<double>(i) * turn_deg * std::numbers::pi / 180.0;
    estimate[i] = Se3(so3_exp({0, 0, angle}), estimate[i].translation());  // about the way ahead
  }
  const Evaluation e = evaluated(straight(11, 1.0), estimate);
  EXPECT_NEAR(e.rpe_rmse_deg, turn_deg, 1e-12);
  EXPECT_NEAR(e.drift_deg_per_m.value(), turn_deg, 1e-12);
  EXPECT_NEAR(e.end_error_deg, 10 * turn_deg, 1e-12);
  EXPECT_NEAR(e.rpe_rmse_m, 0.0, 1e-12);
}

TEST(Evaluate, ShowsOneLostStepOnce) {
  std::vector<Se3> estimate = straight(5, 1.0);
  for (std::size_t i = 3; i < 5; ++i) {
    estimate[i] = Se3(estimate[i].rotation(), estimate[i].translation() - Vector3(0, 0, 1));
  }
  const Evaluation e = evaluated(straight(5, 1.0), estimate);
  EXPECT_NEAR(e.rpe_rmse_m, std::sqrt(1.0 / 4.0), 1e-12);
}

TEST(Evaluate, HasNoDriftForPathsUnderFiveMetres) {
  const Evaluation e = evaluated(straight(10, 0.5), straight(10, 0.5));
  EXPECT_NEAR(e.path_m, 4.5, 1e-12);
  EXPECT_FALSE(e.drift_percent.has_value());
  EXPECT_FALSE(e.drift_deg_per_m.has_value());
}

TEST(Evaluate, HasNoDriftForATruthThatStandsStill) {
  const Evaluation e = evaluated(straight(10, 0.0), straight(10, 0.5));
  EXPECT_FALSE(e.drift_percent.has_value());
  EXPECT_NEAR(e.rpe_rmse_m, 0.5, 1e-12);
}

TEST(Evaluate, UsesLongLengthsFromAHundredMetresOn) {
  // Jitter of every second pose matters over 5 m and hardly over 100 m.
  std::vector<Se3> estimate = straight(202, 1.0);
  for (std::size_t i = 1; i < estimate.size(); i += 2) {
    estimate[i] = Se3(estimate[i].rotation(), estimate[i].translation() + Vector3(1, 0, 0));
  }
  const std::vector<Se3> long_truth = straight(202, 1.0);
  EXPECT_LT(evaluated(long_truth, estimate).drift_percent.value(), 1.1);
  const std::vector<Se3> short_truth(long_truth.begin(), long_truth.begin() + 60);
  EXPECT_GT(evaluated(short_truth, estimate).drift_percent.value(), 1.2);
}

TEST(Evaluate, AlignsWithoutMirroring) {
  // A planar figure: the sign of the smallest singular value is free, a reflection would fit too.
  std::vector<Se3> truth;
  std::vector<Se3> estimate;
  for (int i = 0; i < 12; ++i) {
    const Vector3 p(std::cos(0.7 * i), std::sin(1.1 * i), 0);
    truth.push_back({Eigen::Quaterniond::Identity(), p});
    estimate.push_back({Eigen::Quaterniond::Identity(), Vector3(-p.x(), p.y(), 0.01 * i)});
  }
  // A turn about y by 180° makes (-x, y) of (x, y) in the plane; z is left over, up to 0.11.
  EXPECT_LT(evaluated(truth, estimate).ate_rmse_m, 0.05);
  EXPECT_GT(evaluated(truth, estimate).ate_rmse_m, 0.01);
}

// Figures of an independent implementation (numpy) on the same poses, written with 17 digits.
TEST(Evaluate, AgreesWithAnotherImplementationOnALongWalk) {
  const auto walk = test::random_walk(1, 260, 1.5, 0.02);
  const Evaluation e = evaluated(walk.truth, walk.estimate);
  EXPECT_NEAR(e.drift_percent.value(), 5.484078877574001, 1e-9);
  EXPECT_NEAR(e.drift_deg_per_m.value(), 0.03982534094560004, 1e-9);
  EXPECT_NEAR(e.ate_rmse_m, 2.0401928973877252, 1e-9);
  EXPECT_NEAR(e.rpe_rmse_m, 0.02005020003895249, 1e-9);
  EXPECT_NEAR(e.rpe_rmse_deg, 0.5663253173456174, 1e-9);
  EXPECT_NEAR(e.end_error_m, 44.099099304452224, 1e-9);
  EXPECT_NEAR(e.end_error_deg, 11.362508162894633, 1e-9);
  EXPECT_NEAR(e.path_m, 389.0613740910142, 1e-9);
}

TEST(Evaluate, AgreesWithAnotherImplementationOnAShortWalk) {
  const auto walk = test::random_walk(2, 90, 0.4, 0.01);
  const Evaluation e = evaluated(walk.truth, walk.estimate);
  EXPECT_NEAR(e.drift_percent.value(), 0.9508738781617083, 1e-9);
  EXPECT_NEAR(e.drift_deg_per_m.value(), 0.09203234458822294, 1e-9);
  EXPECT_NEAR(e.ate_rmse_m, 0.03504345190295595, 1e-9);
  EXPECT_NEAR(e.rpe_rmse_m, 0.010299148097127939, 1e-9);
  EXPECT_NEAR(e.rpe_rmse_deg, 0.2760082092179429, 1e-9);
}

TEST(Evaluate, AgreesWithAnotherImplementationOnTruthOfAHigherRate) {
  const auto walk = test::random_walk(3, 120, 0.25, 0.005);
  constexpr std::int64_t kStart_ns = 1403636584763555584;
  Trajectory truth = rows_of(walk.truth);
  Trajectory estimate{.frame = PoseFrame::kBody, .key = PoseKey::kStamp, .poses = {}};
  truth.frame = estimate.frame;
  truth.key = estimate.key;
  for (std::size_t i = 0; i < walk.truth.size(); ++i) {
    const std::int64_t stamp_ns = kStart_ns + 5'000'000 * static_cast<std::int64_t>(i);
    truth.poses[i].stamp = frame_time_from_ns(stamp_ns);
    if (i % 3 != 0) continue;
    estimate.poses.push_back(
        {frame_time_from_ns(stamp_ns + 1'200'000), to_affine(walk.estimate[i])});
  }
  const auto e = evaluate(truth, estimate);
  ASSERT_TRUE(e) << e.error().message;
  EXPECT_EQ(e->matched_poses, 40);
  EXPECT_NEAR(e->drift_percent.value(), 0.6926326610790713, 1e-9);
  EXPECT_NEAR(e->drift_deg_per_m.value(), 0.06660266371751786, 1e-9);
  EXPECT_NEAR(e->ate_rmse_m, 0.030979811704189203, 1e-9);
  EXPECT_NEAR(e->rpe_rmse_m, 0.00861535036082553, 1e-9);
  EXPECT_NEAR(e->rpe_rmse_deg, 0.24497552611018622, 1e-9);
}

}  // namespace
}  // namespace darkling
