// SPDX-License-Identifier: Apache-2.0
#include "io/confidence.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/evaluate.h"
#include "support/random_walk.h"
#include "vo/covariance.h"

namespace darkling {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180.0;

// Of 1 mm and 0.1 deg in every direction.
Matrix6 small_covariance() {
  Vector6 variances;
  variances << Vector3::Constant(1e-6), Vector3::Constant(0.01 * kDegree * kDegree);
  return variances.asDiagonal();
}

// A motion that is off by so many metres to the side and degrees about the way ahead.
bool is_wrong(double off_m, double off_deg, double true_step_m,
              const Matrix6& covariance = small_covariance()) {
  Vector6 xi = Vector6::Zero();
  xi[0] = off_m;
  xi[5] = off_deg * kDegree;
  ConfidenceCount count;
  count.add(0, xi, covariance, true_step_m);
  EXPECT_EQ(count.counts().frames, 1);
  return count.counts().wrong.size() == 1;
}

TEST(Confidence, IsWrongBeyondThreeSigmasAndFivePercentOfTheStep) {
  EXPECT_FALSE(is_wrong(0.0, 0.0, 0.1));
  EXPECT_TRUE(is_wrong(0.0052, 0.0, 0.1));
  EXPECT_FALSE(is_wrong(0.0048, 0.0, 0.1));  // large for σ, not for the step
  EXPECT_FALSE(is_wrong(0.0052, 0.0, 0.1, 4.0 * small_covariance()));  // the other way round
}

TEST(Confidence, IsNotWrongByMillimetresWhenStandingStill) {
  const Matrix6 tiny = 0.01 * small_covariance();
  EXPECT_FALSE(is_wrong(0.0009, 0.0, 0.0, tiny));
  EXPECT_TRUE(is_wrong(0.0011, 0.0, 0.0, tiny));
}

TEST(Confidence, IsWrongBeyondThreeSigmasAndHalfADegree) {
  EXPECT_TRUE(is_wrong(0.0, 0.51, 0.1));
  EXPECT_FALSE(is_wrong(0.0, 0.49, 0.1));
  EXPECT_FALSE(is_wrong(0.0, 0.51, 0.1, 4.0 * small_covariance()));
}

TEST(Confidence, DoesNotLetAPartHideTheOther) {
  Matrix6 covariance = small_covariance();
  covariance.bottomRightCorner<3, 3>() *= 1e6;
  EXPECT_TRUE(is_wrong(0.006, 2.0, 0.1, covariance));
  EXPECT_FALSE(is_wrong(0.0, 2.0, 0.1, covariance));
}

TEST(Confidence, IsNeverWrongWhereNothingIsClaimed) {
  EXPECT_FALSE(is_wrong(1.0, 10.0, 0.1, unknown_covariance()));
  EXPECT_FALSE(is_wrong(1.0, 10.0, 0.1, Matrix6::Zero()));
}

TEST(Confidence, TakesAStateAndAQuality) {
  Estimate estimate;
  estimate.status = TrackStatus::kValid;
  estimate.quality = 50;
  EXPECT_TRUE(is_confident(estimate));
  estimate.quality = 49;
  EXPECT_FALSE(is_confident(estimate));
  estimate.quality = 100;
  estimate.status = TrackStatus::kDegraded;
  EXPECT_FALSE(is_confident(estimate));
}

// Twenty steps of 0.1 m straight ahead, published as they are; poses besides are right.
struct Published {
  std::vector<Se3> poses = {Se3()};
  std::vector<PoseUncertainty> uncertain;

  Published() {
    const Se3 step(Eigen::Quaterniond::Identity(), Vector3(0, 0, 0.1));
    while (poses.size() < 21) poses.push_back(poses.back() * step);
    uncertain.assign(poses.size(), {.cov_motion = small_covariance(),
                                    .cov_pose = small_covariance(),
                                    .reset_counter = 0,
                                    .confident_motion = step});
  }

  [[nodiscard]] std::optional<Confidence> evaluated(const TruthNoise& noise = {}) const {
    const auto evaluation = evaluate(test::rows_of(poses), test::rows_of(poses), uncertain, noise);
    EXPECT_TRUE(evaluation) << evaluation.error().message;
    return evaluation ? evaluation->confidence : std::nullopt;
  }
};

TEST(EvaluateConfidence, CountsPublishedMotionsThatAreOff) {
  Published published;
  EXPECT_EQ(published.evaluated()->frames, 20);
  EXPECT_THAT(published.evaluated()->wrong, IsEmpty());
  const Se3 off(Eigen::Quaterniond::Identity(), Vector3(0, 0, 0.11));
  published.uncertain[7].confident_motion = off;
  published.uncertain[8].confident_motion = off;
  EXPECT_THAT(published.evaluated()->wrong, ElementsAre(7, 8));
  published.uncertain[8].confident_motion.reset();
  EXPECT_EQ(published.evaluated()->frames, 19);
  EXPECT_THAT(published.evaluated()->wrong, ElementsAre(7));
  // The truth may be what is off.
  EXPECT_THAT(published.evaluated({.share = 0.05})->wrong, IsEmpty());
}

TEST(EvaluateConfidence, IsUnknownWithoutUncertainties) {
  Published published;
  published.uncertain.clear();
  EXPECT_FALSE(published.evaluated());
}

}  // namespace
}  // namespace darkling
