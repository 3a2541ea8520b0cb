// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/kernel_cases.h"
#include "support/window_stages.h"

namespace darkling {
namespace {

using test::PlaneWindow;

// Root mean square, px, of what the poses err by in their keyframes' images.
double pose_error_px(PlaneWindow& stages) {
  double sum = 0.0;
  for (int k = 1; k < stages.window().count; ++k) {
    const WindowKeyframe& keyframe = stages.window().keyframes()[k];
    const double error_px = test::image_motion_px(
        stages.window(), keyframe, PlaneWindow::T_world_true(k), keyframe.T_world_key);
    sum += error_px * error_px;
  }
  return std::sqrt(sum / (stages.window().count - 1));
}

// Root mean square, px, of the disparities' errors.
double depth_error_px(PlaneWindow& stages, const test::PlaneWorld& world) {
  const RectifiedRig& rig = stages.rig();
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < stages.window().count; ++k) {
    const TemplatePoints& points = stages.window().keyframes()[k].points;
    for (int i = 0; i < points.count; ++i, ++count) {
      const double depth_m =
          world.depth_m(rig, PlaneWindow::T_world_true(k), double(points.x[i]) + rig.cx,
                        double(points.y[i]) + rig.cy);
      const double error_px =
          rig.baseline_m * (double(points.inverse_depth_focal[i]) - rig.focal_px / depth_m);
      sum += error_px * error_px;
    }
  }
  return std::sqrt(sum / count);
}

// Moves every pose but the oldest by some tenths of a pixel.
void disturb(PlaneWindow& stages, std::uint64_t seed) {
  test::Random random(seed);
  for (int k = 1; k < stages.window().count; ++k) {
    Vector6 xi;
    xi << random.vector<3>(0.008), random.vector<3>(0.002);
    Se3& T_world_key = stages.window().keyframes()[k].T_world_key;
    T_world_key = plus(T_world_key, xi);
  }
}

TEST(RefineWindow, BringsDisturbedPosesAndDepthsNearerTheTruth) {
  const test::PlaneWorld world;
  double before_px = 0.0;
  double after_px = 0.0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    PlaneWindow stages(world, {.points = 300, .disparity_sigma_px = 0.2});
    disturb(stages, seed);
    const double pose_before_px = pose_error_px(stages);
    const double depth_before_px = depth_error_px(stages, world);
    ASSERT_GT(pose_before_px, 0.15);
    ASSERT_EQ(stages.refine(), Refinement::kApplied);
    EXPECT_LT(pose_error_px(stages), 0.5 * pose_before_px) << seed;
    EXPECT_LT(depth_error_px(stages, world), depth_before_px) << seed;
    before_px += pose_before_px;
    after_px += pose_error_px(stages);
  }
  RecordProperty("mean_error_px", std::to_string(after_px / 4));
  EXPECT_LT(after_px, 0.3 * before_px);
}

// Keyframe by keyframe, as the odometry goes.
TEST(RefineWindow, LeavesTruePosesAndImprovesDepths) {
  const test::PlaneWorld world;
  PlaneWindow stages(world, {.points = 300, .disparity_sigma_px = 0.2});
  ASSERT_EQ(stages.refine(), Refinement::kApplied);
  EXPECT_LT(pose_error_px(stages), 0.05);
  EXPECT_LT(depth_error_px(stages, world), 0.9 * 0.2);
}

TEST(RefineWindow, NeverMovesTheOldestKeyframe) {
  const test::PlaneWorld world;
  PlaneWindow stages(world, {.keyframes = 3});
  for (int k = 3; k < 6; ++k) {
    disturb(stages, k);
    const Eigen::Matrix4d oldest = stages.window().keyframes()[0].T_world_key.matrix();
    ASSERT_EQ(stages.refine(), Refinement::kApplied);
    EXPECT_EQ(stages.window().keyframes()[0].T_world_key.matrix(), oldest);
    stages.add(world, PlaneWindow::T_world_true(k));
  }
}

TEST(RefineWindow, GivesTheSameBytesWithEveryKernel) {
  const test::PlaneWorld world;
  std::vector<double> expected;
  for (const KernelTable& kernels : test::available_tables()) {
    PlaneWindow stages(world, {.keyframes = 3});
    disturb(stages, 1);
    EXPECT_EQ(stages.refine(kernels), Refinement::kApplied);
    if (expected.empty()) expected = test::estimate_of(stages.window());
    EXPECT_EQ(test::estimate_of(stages.window()), expected) << kernels.name;
  }
}

// In a world where every comparison is true.
TEST(RefineWindow, KnowsMoreOfADepthThanStereoAlone) {
  const test::PlaneWorld world;
  PlaneWindow stages(world);
  ASSERT_EQ(stages.refine(), Refinement::kApplied);
  const WindowKeyframe& oldest = stages.window().keyframes()[0];
  int better = 0;
  int trusted = 0;
  for (int i = 0; i < oldest.points.count; ++i) {
    better += oldest.information[i] > oldest.stereo_information[i] ? 1 : 0;
    trusted += oldest.inlier_ratio[i] > 0.5f ? 1 : 0;
    ASSERT_GE(oldest.inlier_ratio[i], 1.0f / 6.0f);  // four comparisons at most, none agrees
    ASSERT_LE(oldest.inlier_ratio[i], 5.0f / 6.0f);
  }
  EXPECT_GT(better, oldest.points.count * 3 / 4);
  EXPECT_GT(trusted, oldest.points.count / 2);
}

void expect_information_of_estimate(PlaneWindow& stages) {
  stages.linearise();
  for (int k = 0; k < stages.window().count; ++k) {
    const WindowKeyframe& keyframe = stages.window().keyframes()[k];
    for (int i = 0; i < keyframe.points.count; ++i) {
      ASSERT_EQ(keyframe.information[i], 1.0f / stages.equations().depths[k].H[i]);
    }
  }
}

// Not that of a last step that was tried and taken back.
TEST(RefineWindow, KnowsDepthsAsWellAsTheEstimateItKeeps) {
  const test::PlaneWorld world;
  PlaneWindow stages(world);
  for (std::uint64_t seed = 1; seed < 60; ++seed) {
    disturb(stages, seed);
    ASSERT_EQ(stages.refine(), Refinement::kApplied);
    for (int repetition = 0; repetition < 10; ++repetition) {
      expect_information_of_estimate(stages);
      if (stages.refine() != Refinement::kApplied) break;
    }
  }
}

TEST(RefineWindow, DoesNotMoveKeyframesThatStandStill) {
  const test::PlaneWorld world;
  test::WindowStages stages(test::ideal_rig(), {});
  for (int k = 0; k < 5; ++k) {
    stages.add(world, Se3());
    if (k > 0) (void)stages.refine();
  }
  for (const WindowKeyframe& keyframe : stages.window().keyframes()) {
    EXPECT_LT(test::image_motion_px(stages.window(), keyframe, Se3(), keyframe.T_world_key), 0.02);
  }
}

// One plane explains itself: with depths from stereo nothing is missing.
TEST(RefineWindow, RefinesBeforeASinglePlane) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const double slope : {0.0, 0.3}) {
    const test::PlaneWorld wall({.wall_slope = slope, .floor_y_m = kNone});
    PlaneWindow stages(wall, {.points = 300});
    disturb(stages, 5);
    const double before_px = pose_error_px(stages);
    const Refinement outcome = stages.refine();
    EXPECT_EQ(outcome, Refinement::kApplied);
    EXPECT_LT(pose_error_px(stages), 0.5 * before_px);
  }
}

}  // namespace
}  // namespace darkling
