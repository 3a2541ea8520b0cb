// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/window_stages.h"
#include "vo/carry_depth.h"

namespace darkling {
namespace {

constexpr double kWindowSigmaPx = 0.05;    // of the disparities that the window knows
constexpr double kMeasuredSigmaPx = 0.25;  // of those that the new keyframe has measured

// A window that knows a world well, and a new keyframe that has measured it badly.
class CarryDepths : public ::testing::Test {
 protected:
  CarryDepths()
      : stages_(test::ideal_rig(), {.points = 400, .disparity_sigma_px = kWindowSigmaPx}) {
    stages_.add(world_, Se3());
    for (WindowKeyframe& keyframe : window().keyframes()) {
      std::fill_n(keyframe.inlier_ratio, keyframe.points.count, 0.8f);
    }
    measure(T_world_key_);
  }

  // The pixels that the new keyframe chooses, with errors of a known size.
  void measure(const Se3& T_world_key) {
    world_.render(rig_, T_world_key, eye_.grey());
    eye_.prepare(kernels_);
    template_.know_disparities(world_, T_world_key);
    const auto chosen = select_points(kernels_, eye_.pyramid()[0], template_.disparities_at(0),
                                      template_.selector());
    measured_.assign(chosen.begin(), chosen.end());
    test::Random random(2);
    for (PointSelector::Candidate& c : measured_) {
      c.disparity_px += float(random.uniform(-1.0, 1.0) * std::sqrt(3.0) * kMeasuredSigmaPx);
      c.variance_px2 = float(kMeasuredSigmaPx * kMeasuredSigmaPx);
    }
  }
  int carry() { return carry_from(T_world_key_); }
  int carry_from(const Se3& T_world_key) {
    build_template_level(kernels_, measured_, eye_.pyramid()[0], rig_.baseline_m, level());
    return carry_depths(window(), T_world_key, eye_.pyramid()[0], measured_, image_,
                        level().points);
  }

  Window& window() { return stages_.window(); }
  TemplateLevel& level() { return template_.keyframe().levels[0]; }
  [[nodiscard]] double disparity_px(int i) {
    return rig_.baseline_m * double(level().points.inverse_depth_focal[i]);
  }
  [[nodiscard]] bool is_fused(int i) {
    return level().points.inverse_depth_focal[i] !=
           float(double(measured_[i].disparity_px) / rig_.baseline_m);
  }
  [[nodiscard]] int fused_points() {
    int count = 0;
    for (int i = 0; i < level().points.count; ++i) count += is_fused(i) ? 1 : 0;
    return count;
  }
  [[nodiscard]] double true_disparity_px(int i) {
    return rig_.focal_px * rig_.baseline_m /
           world_.depth_m(rig_, T_world_key_, measured_[i].x, measured_[i].y);
  }

  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::PlaneWorld world_;
  test::WindowStages stages_;
  Se3 T_world_key_ = test::motion(0.05, 0.0, 0.15, 0.0, 0.01, 0.0);
  test::EyeStages eye_{rig_, 1};
  test::TemplateStages template_{rig_, 1, 400};
  Arena arena_{1u << 20};
  PointImage image_ = allocate_point_image(rig_, arena_);
  std::vector<PointSelector::Candidate> measured_;
};

TEST_F(CarryDepths, FusedDisparitiesErrLessThanMeasuredOnes) {
  const int fused = carry();
  ASSERT_GT(fused, static_cast<int>(measured_.size()) / 4);
  double measured = 0.0;
  double known = 0.0;
  for (int i = 0; i < level().points.count; ++i) {
    if (!is_fused(i)) continue;
    const double truth = true_disparity_px(i);
    measured += std::pow(double(measured_[i].disparity_px) - truth, 2.0);
    known += std::pow(disparity_px(i) - truth, 2.0);
  }
  RecordProperty("error_px", std::to_string(std::sqrt(known / fused)));
  EXPECT_NEAR(std::sqrt(measured / fused), kMeasuredSigmaPx, 0.1 * kMeasuredSigmaPx);
  EXPECT_LT(std::sqrt(known / fused), 0.5 * kMeasuredSigmaPx);
}

TEST_F(CarryDepths, CountsThePointsItFused) {
  const int fused = carry();
  EXPECT_EQ(fused, fused_points());
}

TEST_F(CarryDepths, LeavesMeasuredDepthsWhereTheWindowIsEmpty) {
  window().count = 0;
  EXPECT_EQ(carry(), 0);
  EXPECT_EQ(fused_points(), 0);
}

TEST_F(CarryDepths, LeavesMeasuredDepthsWhereKeyframesHaveNoPoints) {
  window().newest().points.count = 0;
  EXPECT_EQ(carry(), 0);
  EXPECT_EQ(fused_points(), 0);
}

// The same pixel from the same place: the mean weighted by both variances, exactly.
TEST_F(CarryDepths, WeighsByVariances) {
  T_world_key_ = Se3();
  measure(T_world_key_);
  const WindowKeyframe& host = window().newest();
  int compared = 0;
  (void)carry();
  for (int i = 0; i < level().points.count; ++i) {
    for (int n = 0; n < host.points.count; ++n) {
      if (host.points.x[n] != level().points.x[i] || host.points.y[n] != level().points.y[i]) {
        continue;
      }
      if (!is_fused(i)) continue;
      const double a = 1.0 / (kMeasuredSigmaPx * kMeasuredSigmaPx);
      const double b = 1.0 / (kWindowSigmaPx * kWindowSigmaPx);
      const double carried_px = rig_.baseline_m * double(host.points.inverse_depth_focal[n]);
      const double mean_px = (a * double(measured_[i].disparity_px) + b * carried_px) / (a + b);
      ASSERT_NEAR(disparity_px(i), mean_px, 1e-4);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST_F(CarryDepths, TakesNoPointThatIsBehindTheCamera) {
  EXPECT_EQ(carry_from(test::motion(0.0, 0.0, 20.0, 0.0, 0.0, 0.0)), 0);
  EXPECT_EQ(carry_from(test::motion(0.0, 0.0, 0.0, 0.0, M_PI, 0.0)), 0);
  EXPECT_EQ(fused_points(), 0);
}

TEST_F(CarryDepths, TakesNoPointOutsideTheImage) {
  for (const Se3& T_world_key :
       {test::motion(0, 0, 0, 0, 1.4, 0), test::motion(0, 0, 0, 0, -1.4, 0),
        test::motion(0, 0, 0, 1.4, 0, 0), test::motion(0, 0, 0, -1.4, 0, 0),
        test::motion(500.0, 0, 0, 0, 0, 0), test::motion(0, 500.0, 0, 0, 0, 0)}) {
    EXPECT_EQ(carry_from(T_world_key), 0);
  }
  EXPECT_EQ(fused_points(), 0);
}

TEST_F(CarryDepths, StaysInsideTheImageWhileItTurnsAway) {
  for (int step = -60; step <= 60; ++step) {
    (void)carry_from(test::motion(0.01 * step, 0, 0, 0.005 * step, 0.02 * step, 0.05 * step));
    for (int i = 0; i < level().points.count; ++i) ASSERT_TRUE(std::isfinite(disparity_px(i)));
  }
}

TEST_F(CarryDepths, TakesNoPointWhoseDepthIsNoNumber) {
  TemplatePoints& points = window().newest().points;
  for (const float s :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::fill_n(points.inverse_depth_focal, points.count, s);
    EXPECT_EQ(carry(), 0) << s;
  }
}

TEST_F(CarryDepths, TakesNoPointThatDisagreesWithItsImagesMostly) {
  WindowKeyframe& host = window().newest();
  std::fill_n(host.inlier_ratio, host.points.count, 0.49f);
  EXPECT_EQ(carry(), 0);
  EXPECT_EQ(fused_points(), 0);
  std::fill_n(host.inlier_ratio, host.points.count, 0.5f);  // as before any comparison
  EXPECT_GT(carry(), 0);
}

// 3 σ of the difference. A neighbour's σ may be larger by a pixel's slope, not its agreement.
TEST_F(CarryDepths, TakesNoPointThatStereoContradicts) {
  T_world_key_ = Se3();
  measure(T_world_key_);
  const TemplatePoints& points = window().newest().points;
  const double sigma_px = std::hypot(kMeasuredSigmaPx, kWindowSigmaPx);
  for (const auto& [sigmas, is_near] : {std::pair(2.8, true), std::pair(3.8, false)}) {
    for (int n = 0; n < points.count; ++n) points.inverse_depth_focal[n] = 20.0f;  // 4 px
    for (PointSelector::Candidate& c : measured_) c.disparity_px = float(4.0 + sigmas * sigma_px);
    EXPECT_EQ(carry() > 100, is_near) << sigmas;
    EXPECT_EQ(fused_points() > 0, is_near) << sigmas;
  }
}

TEST_F(CarryDepths, GivesTheSameBytesOnEveryRun) {
  (void)carry();
  const float* depths = level().points.inverse_depth_focal;
  const std::vector<float> first(depths, depths + level().points.count);
  (void)carry_from(test::motion(0.3, 0, 0, 0, 0, 0));  // leaves marks of its own
  (void)carry();
  EXPECT_EQ(std::vector<float>(depths, depths + level().points.count), first);
}

}  // namespace
}  // namespace darkling
