// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "io/nees.h"
#include "support/kernel_cases.h"
#include "support/random.h"
#include "support/vo_stages.h"
#include "vo/covariance.h"

namespace darkling {
namespace {

constexpr int kPoints = 800;

Se3 motion(double x, double y, double z, double rx, double ry, double rz) {
  Vector6 xi;
  xi << x, y, z, rx, ry, rz;
  return Se3::exp(xi);
}

// A keyframe at the identity in a world of wall and floor, and frames aligned to it.
class AlignmentCovariance : public ::testing::Test {
 protected:
  AlignmentCovariance() {
    world_.render(rig_, Se3(), clean_key_.grey());
    key_.know_disparities(world_, Se3());
    for (int y = 0; y < rig_.height; ++y) {
      const float* row = key_.disparity().row(y);
      disparity_.insert(disparity_.end(), row, row + rig_.width);
    }
  }

  // A keyframe with noise of its own, and true depths that are off by up to `depth_error`.
  void make_keyframe(double noise_levels, double depth_error = 0.0) {
    add_noise(clean_key_.grey(), noise_levels, eye_.grey());
    eye_.prepare(kernels_);
    const ImageView<float> disparity = key_.disparity();
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        const auto off = static_cast<float>(1.0 + random_.uniform(-depth_error, depth_error));
        disparity.at(x, y) = off * disparity_[static_cast<std::size_t>(y * rig_.width + x)];
      }
    }
    key_.build(kernels_, eye_.pyramid());
  }

  // Aligns to `view`, what is seen from `T_key_current`, with fresh noise.
  Alignment align(test::EyeStages& view, const Se3& T_key_current, double noise_levels) {
    add_noise(view.grey(), noise_levels, eye_.grey());
    eye_.prepare(kernels_);
    const Se3 guess = T_key_current.inverse();
    return align_frame(kernels_, key_.keyframe(), eye_.pyramid(), {&guess, 1}, key_.residuals());
  }
  Alignment align(const Se3& T_key_current, double noise_levels) {
    world_.render(rig_, T_key_current, view_.grey());
    return align(view_, T_key_current, noise_levels);
  }

  AlignmentCovariances covariances_of(const Alignment& alignment, bool is_first,
                                      const KernelTable& kernels = {}) {
    return estimate_covariances(kernels, aligned(alignment), is_first, influences_);
  }
  [[nodiscard]] AlignedFrame aligned(const Alignment& alignment) {
    return {.rig = rig_,
            .finest = key_.keyframe().levels[0],
            .alignment = alignment,
            .residuals = key_.residuals()};
  }

  void add_noise(ImageView<const std::uint8_t> from, double sigma, ImageView<std::uint8_t> to) {
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        double sum = -6.0;  // of twelve: about normal, variance 1
        for (int i = 0; i < 12; ++i) sum += random_.uniform(0.0, 1.0);
        to.at(x, y) =
            static_cast<std::uint8_t>(std::clamp(from.at(x, y) + sigma * sum, 0.0, 255.0));
      }
    }
  }

  test::Random random_{7};
  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::PlaneWorld world_;
  test::EyeStages clean_key_{rig_, 1};
  test::EyeStages view_{rig_, 1};
  test::EyeStages view_before_{rig_, 1};
  test::EyeStages eye_{rig_, 3};
  test::TemplateStages key_{rig_, 3, kPoints};
  std::vector<float> disparity_;  // the true one
  Arena arena_{1u << 20};
  PointInfluences influences_ = allocate_influences(kPoints, arena_);
};

// What 200 draws of the noise do is what each of them promises, in every direction.
TEST_F(AlignmentCovariance, ForetellsTheSpreadOfAlignments) {
  constexpr int kDraws = 200;
  const Se3 T_key_current = motion(0.03, 0.01, 0.05, 0.002, 0.004, 0.003);
  world_.render(rig_, T_key_current, view_.grey());
  Matrix6 spread = Matrix6::Zero();
  Matrix6 promised = Matrix6::Zero();
  NeesMean nees;
  for (int draw = 0; draw < kDraws; ++draw) {
    make_keyframe(6.0);
    const Alignment alignment = align(view_, T_key_current, 6.0);
    const Matrix6 covariance = covariances_of(alignment, true).of_alignment;
    const Vector6 xi = minus(alignment.T_current_key, T_key_current.inverse());
    spread += xi * xi.transpose() / kDraws;
    promised += covariance / kDraws;
    nees.add(xi, covariance);
  }
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(promised(i, i), 0.5 * spread(i, i)) << i;
    EXPECT_LT(promised(i, i), 2.0 * spread(i, i)) << i;
  }
  ASSERT_EQ(nees.mean()->count, kDraws);
  RecordProperty("nees", std::to_string(nees.mean()->mean));
  EXPECT_GT(nees.mean()->mean, 0.5);
  EXPECT_LT(nees.mean()->mean, 2.0);
}

// Wrong depths put both frames off alike, so the motion between them is known better than either.
TEST_F(AlignmentCovariance, LeavesOutOfAMotionWhatBothFramesHaveInCommon) {
  constexpr int kDraws = 100;
  const Se3 T_key_before = motion(0.10, 0.0, 0.05, 0.0, 0.004, 0.0);
  const Se3 T_key_current = motion(0.11, 0.0, 0.06, 0.0, 0.005, 0.0);
  world_.render(rig_, T_key_before, view_before_.grey());
  world_.render(rig_, T_key_current, view_.grey());
  NeesMean change;
  double change_over_each = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    make_keyframe(2.0, 0.15);
    const Alignment before = align(view_before_, T_key_before, 2.0);
    (void)covariances_of(before, true);
    const Alignment current = align(view_, T_key_current, 2.0);
    const AlignmentCovariances covariances = covariances_of(current, false);
    change.add(minus(current.T_current_key, T_key_current.inverse()) -
                   minus(before.T_current_key, T_key_before.inverse()),
               covariances.of_change);
    change_over_each += covariances.of_change.trace() / covariances.of_alignment.trace() / kDraws;
  }
  EXPECT_LT(change_over_each, 0.7);
  RecordProperty("nees", std::to_string(change.mean()->mean));
  EXPECT_GT(change.mean()->mean, 0.5);
  EXPECT_LT(change.mean()->mean, 2.0);
}

TEST_F(AlignmentCovariance, IsNeverZeroEvenWhereNothingMoved) {
  make_keyframe(0.0);
  const Alignment alignment = align(Se3(), 0.0);
  const AlignmentCovariances covariances = covariances_of(alignment, true);
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(covariances.of_change);
  EXPECT_GT(solver.eigenvalues()[0], 1e-9);
  EXPECT_LT(solver.eigenvalues()[5], 1e-5);
}

TEST_F(AlignmentCovariance, IsNotKnownWhereTheAlignmentConstrainsNothing) {
  make_keyframe(0.0);
  Alignment alignment = align(Se3(), 0.0);
  alignment.information.setZero();
  EXPECT_EQ(covariances_of(alignment, true).of_alignment, unknown_covariance());
  EXPECT_FALSE(is_known(unknown_covariance()));
  EXPECT_FALSE(is_known(Matrix6::Constant(std::nan(""))));
  EXPECT_TRUE(is_known(Matrix6::Zero()));
}

TEST_F(AlignmentCovariance, HasTheSameBitsWithEveryKernel) {
  make_keyframe(3.0);
  const Alignment alignment = align(motion(0.03, 0, 0.05, 0, 0.005, 0), 3.0);
  const AlignmentCovariances expected = covariances_of(alignment, true);
  for (const KernelTable& kernels : test::available_tables()) {
    const AlignmentCovariances covariances = covariances_of(alignment, true, kernels);
    EXPECT_EQ(covariances.of_alignment, expected.of_alignment) << kernels.name;
    EXPECT_EQ(covariances.of_change, expected.of_change) << kernels.name;
  }
}

TEST_F(AlignmentCovariance, OfThePoseGoesOnFromKeyframeToKeyframe) {
  make_keyframe(3.0);
  const Se3 T_key_current = motion(0.05, 0, 0.1, 0, 0.01, 0);
  const Alignment alignment = align(T_key_current, 3.0);
  PoseCovariance path;
  EXPECT_EQ(path.pose(), Matrix6::Zero());
  path.move(kernels_, aligned(alignment), influences_);
  const Matrix6 once = path.pose();
  EXPECT_TRUE(is_known(once));
  // The pose counts what keyframes share; the motion from the start is the same motion.
  EXPECT_GT(once.trace(), path.motion().trace());
  const Matrix6 motion_once = path.motion();
  path.set_keyframe();
  EXPECT_EQ(path.pose(), once);
  path.move(kernels_, aligned(alignment), influences_);
  EXPECT_LT((path.motion() - motion_once).norm(), 1e-9 * once.norm());
  EXPECT_GT(path.pose().trace(), 1.9 * once.trace());
  path.reset();
  EXPECT_EQ(path.pose(), Matrix6::Zero());
}

// The same error of scale on both halves of a straight way: twice as far off, not √2 times.
TEST_F(AlignmentCovariance, AddsUpErrorsOfScaleBeforeTheyAreSquared) {
  make_keyframe(0.0);
  Alignment alignment = align(Se3(), 0.0);
  alignment.T_current_key = motion(0, 0, -20.0, 0, 0, 0);  // so far that nothing else counts
  PoseCovariance path;
  path.move(kernels_, aligned(alignment), influences_);
  const double once = path.pose()(2, 2);
  path.set_keyframe();
  path.move(kernels_, aligned(alignment), influences_);
  EXPECT_NEAR(path.pose()(2, 2) / once, 4.0, 0.01);
}

// T exp(ξ) S = T S exp(Ad(S⁻¹) ξ).
TEST(TransportCovariance, IsThatOfThePerturbationSeenFromTheOtherFrame) {
  test::Random random(3);
  const Se3 T_b_a = Se3::exp(random.vector<6>(1.0));
  const Se3 T_x_a = Se3::exp(random.vector<6>(1.0));
  const Vector6 xi = random.vector<6>(1e-6);
  const Vector6 seen = minus(plus(T_x_a, xi) * T_b_a.inverse(), T_x_a * T_b_a.inverse());
  const Matrix6 covariance = transport_covariance(xi * xi.transpose(), T_b_a);
  EXPECT_LT((covariance - seen * seen.transpose()).norm(), 1e-5 * covariance.norm());
  EXPECT_EQ(transport_covariance(unknown_covariance(), T_b_a), unknown_covariance());
}

}  // namespace
}  // namespace darkling
