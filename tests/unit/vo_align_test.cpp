// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "support/kernel_cases.h"
#include "support/random.h"
#include "support/vo_stages.h"
#include "vo/align.h"

namespace darkling {
namespace {

// A keyframe at the identity in a world of wall and floor, and a second eye to align to it.
class AlignFrame : public ::testing::Test {
 protected:
  AlignFrame() {
    world_.render(rig_, Se3(), key_eye_.grey());
    key_eye_.prepare(kernels_);
    key_.know_disparities(world_, Se3());
    key_.build(kernels_, key_eye_.pyramid());
  }

  // Aligns to what is seen from `T_key_current`.
  Alignment align(const Se3& T_key_current, std::span<const Se3> guesses) {
    world_.render(rig_, T_key_current, eye_.grey());
    eye_.prepare(kernels_);
    return align_frame(kernels_, key_.keyframe(), eye_.pyramid(), guesses, key_.residuals());
  }
  Alignment align_from_rest(const Se3& T_key_current) {
    const Se3 rest;
    return align(T_key_current, {&rest, 1});
  }

  // Root mean square distance, px, between where the template's points are and where the alignment
  // puts them.
  [[nodiscard]] double error_px(const Alignment& alignment, const Se3& T_key_current) {
    const TemplatePoints& points = key_.keyframe().levels[0].points;
    const auto pixel = [&](const Se3& T_current_key, int i) {
      const double depth_m = rig_.focal_px / points.inverse_depth_focal[i];
      const Vector3 p(points.x[i] / rig_.focal_px * depth_m, points.y[i] / rig_.focal_px * depth_m,
                      depth_m);
      const Vector3 q = T_current_key * p;
      return Eigen::Vector2d(rig_.focal_px * q.head<2>() / q.z());
    };
    double sum = 0.0;
    for (int i = 0; i < points.count; ++i) {
      sum += (pixel(alignment.T_current_key, i) - pixel(T_key_current.inverse(), i)).squaredNorm();
    }
    return std::sqrt(sum / points.count);
  }

  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::PlaneWorld world_;
  test::EyeStages key_eye_{rig_, 3};
  test::EyeStages eye_{rig_, 3};
  test::TemplateStages key_{rig_, 3, 800};
};

Se3 motion(double x, double y, double z, double rx, double ry, double rz) {
  Vector6 xi;
  xi << x, y, z, rx, ry, rz;
  return Se3::exp(xi);
}

TEST_F(AlignFrame, StaysWhereItIsWhenNothingMoved) {
  const Alignment alignment = align_from_rest(Se3());
  EXPECT_TRUE(alignment.has_converged);
  EXPECT_LT(error_px(alignment, Se3()), 1e-3);
  EXPECT_LT(alignment.score.cost, 0.01);
  EXPECT_GT(alignment.score.visible_fraction, 0.99);
}

// One motion a direction of the tangent space, and all at once: every column of the Jacobian must
// be right for the last to converge.
TEST_F(AlignFrame, RecoversSmallMotionsInEveryDirection) {
  const Se3 motions[] = {motion(0.05, 0, 0, 0, 0, 0),
                         motion(0, 0.05, 0, 0, 0, 0),
                         motion(0, 0, 0.10, 0, 0, 0),
                         motion(0, 0, 0, 0.01, 0, 0),
                         motion(0, 0, 0, 0, 0.01, 0),
                         motion(0, 0, 0, 0, 0, 0.02),
                         motion(-0.04, 0.03, 0.12, -0.008, 0.012, 0.015)};
  for (const Se3& T_key_current : motions) {
    SCOPED_TRACE(testing::Message() << T_key_current.log().transpose());
    const Alignment alignment = align_from_rest(T_key_current);
    EXPECT_TRUE(alignment.has_converged);
    EXPECT_LT(alignment.score.cost, 0.25);
    EXPECT_LT(error_px(alignment, T_key_current), 0.05);
    EXPECT_LT(minus(alignment.T_current_key, T_key_current.inverse()).norm(), 0.004);
  }
}

// Each point knows its place to some 0.15 px; 800 of them leave √(6/800) of that to six unknowns.
TEST_F(AlignFrame, ErrsOnAverageByLessThanThreeHundredthsOfAPixel) {
  test::Random random(4);
  double sum = 0.0;
  constexpr int kTrials = 12;
  for (int trial = 0; trial < kTrials; ++trial) {
    Vector6 xi;
    xi << random.vector<3>(0.02), random.vector<3>(0.005);  // 2 px on the floor, 0.6 px beyond
    const Se3 T_key_current = Se3::exp(xi);
    sum += error_px(align_from_rest(T_key_current), T_key_current);
  }
  RecordProperty("mean_error_px", std::to_string(sum / kTrials));
  EXPECT_LT(sum / kTrials, 0.03);
}

TEST_F(AlignFrame, TellsAWrongMotionFromARightOneByItsError) {
  Alignment alignment;
  EXPECT_GT(error_px(alignment, motion(0.01, 0, 0, 0, 0, 0)), 0.15);
  EXPECT_GT(error_px(alignment, motion(0, 0, 0, 0, 0.001, 0)), 0.1);
}

TEST_F(AlignFrame, ConvergesInAFewStepsALevel) {
  const Alignment alignment = align_from_rest(motion(0.03, 0, 0.05, 0, 0.005, 0));
  EXPECT_LE(alignment.iterations, 45);
  EXPECT_GE(alignment.iterations, 3);  // at least one a level
}

TEST_F(AlignFrame, TakesTheBetterOfTwoGuesses) {
  const Se3 T_key_current = motion(0.02, 0.0, 0.04, 0.0, 0.004, 0.0);
  const Se3 wrong = motion(2.5, 1.0, 1.5, 0.5, -0.6, 0.4);
  const Se3 guesses[] = {wrong, Se3()};
  const Alignment from_wrong = align(T_key_current, {&wrong, 1});
  const Alignment from_both = align(T_key_current, guesses);
  EXPECT_GT(error_px(from_wrong, T_key_current), 1.0);
  EXPECT_LT(error_px(from_both, T_key_current), 0.05);
  EXPECT_GT(from_wrong.score.rank(), from_both.score.rank() + 0.1);
}

TEST_F(AlignFrame, NeedsTheVelocityWhenTheStepIsLong) {
  const Se3 T_key_current = motion(1.6, 0.0, 0.0, 0.0, 0.20, 0.0);
  const Se3 guesses[] = {(T_key_current * motion(0.05, 0, 0.05, 0, 0.01, 0)).inverse(), Se3()};
  EXPECT_GT(error_px(align_from_rest(T_key_current), T_key_current), 1.0);
  EXPECT_LT(error_px(align(T_key_current, guesses), T_key_current), 0.2);
}

TEST_F(AlignFrame, SaysThatNothingIsVisibleWhenItLooksTheOtherWay) {
  const Se3 behind = motion(0, 0, 0, 0, 3.1, 0);
  const Alignment alignment = align(Se3(), {&behind, 1});
  EXPECT_EQ(alignment.score.visible_count, 0);
  EXPECT_EQ(alignment.score.visible_fraction, 0.0);
  EXPECT_EQ(alignment.score.cost, 1.0);
  EXPECT_FALSE(alignment.has_converged);
}

TEST_F(AlignFrame, SaysThatNothingIsVisibleOfAnEmptyTemplate) {
  for (TemplateLevel& level : key_.keyframe().levels) level.points.count = 0;
  const Alignment alignment = align_from_rest(Se3());
  EXPECT_EQ(alignment.score.visible_count, 0);
  EXPECT_FALSE(alignment.has_converged);
}

TEST_F(AlignFrame, StaysFiniteOnFlatAndOnUnrelatedFrames) {
  const Se3 rest;
  for (const test::Fill fill : {test::Fill::kConstant, test::Fill::kUniform}) {
    test::fill_image(eye_.grey(), fill, 1);
    eye_.prepare(kernels_);
    const Alignment alignment =
        align_frame(kernels_, key_.keyframe(), eye_.pyramid(), {&rest, 1}, key_.residuals());
    EXPECT_TRUE(alignment.T_current_key.matrix().allFinite()) << test::name_of(fill);
    EXPECT_GT(alignment.score.cost, 0.6) << test::name_of(fill);
  }
}

TEST_F(AlignFrame, GivesTheSameBitsWithEveryKernel) {
  const Se3 T_key_current = motion(0.02, -0.01, 0.05, 0.002, 0.004, -0.003);
  world_.render(rig_, T_key_current, eye_.grey());
  eye_.prepare(kernels_);
  const Se3 rest;
  const Alignment expected =
      align_frame(kernels_, key_.keyframe(), eye_.pyramid(), {&rest, 1}, key_.residuals());
  for (const KernelTable& kernels : test::available_tables()) {
    const Alignment alignment =
        align_frame(kernels, key_.keyframe(), eye_.pyramid(), {&rest, 1}, key_.residuals());
    EXPECT_EQ(alignment.T_current_key.matrix(), expected.T_current_key.matrix()) << kernels.name;
    EXPECT_EQ(alignment.score.cost, expected.score.cost) << kernels.name;
  }
}

// The information is that of a right perturbation, so its inverse must foretell which motions of
// the pair are hard to tell apart: sideways motion and yaw.
TEST_F(AlignFrame, KnowsThatSidewaysMotionLooksLikeYaw) {
  const Alignment alignment = align_from_rest(motion(0.02, 0, 0, 0, 0, 0));
  const Matrix6 covariance = alignment.information.inverse();
  EXPECT_TRUE(covariance.allFinite());
  const double correlation = covariance(0, 4) / std::sqrt(covariance(0, 0) * covariance(4, 4));
  EXPECT_LT(correlation, -0.3);
  EXPECT_LT(std::abs(covariance(2, 5) / std::sqrt(covariance(2, 2) * covariance(5, 5))), 0.3);
}

}  // namespace
}  // namespace darkling
