// SPDX-License-Identifier: Apache-2.0
#include <set>
#include <vector>

#include "support/plane_world.h"
#include "vo/window.h"

namespace darkling {
namespace {

constexpr int kCapacity = 50;

// Points whose every number tells which one it is.
class AddKeyframe : public ::testing::Test {
 protected:
  AddKeyframe() {
    OdometryConfig config;
    config.window_keyframes = 3;
    config.window_points = kCapacity;
    allocate_window(rig_, config, arena_, window_);
    points_ = allocate_points(200, "points", "patches", arena_);
  }

  void add(int count, double x_m = 0.0) {
    points_.count = count;
    candidates_.resize(count);
    for (int i = 0; i < count; ++i) {
      const auto number = static_cast<float>(i);
      points_.x[i] = number;
      points_.y[i] = number + 1000.0f;
      points_.inverse_depth_focal[i] = number + 2000.0f;
      points_.Sxx[i] = number + 3000.0f;
      points_.Sxy[i] = number + 4000.0f;
      points_.Syy[i] = number + 5000.0f;
      points_.patches[i].gx2[0] = static_cast<std::int16_t>(i);
      candidates_[i].disparity_px = number + 6000.0f;
      candidates_[i].variance_px2 = number + 1.0f;
    }
    add_keyframe(Se3(Matrix3(Matrix3::Identity()), Vector3(x_m, 0.0, 0.0)), points_, candidates_,
                 window_);
  }
  [[nodiscard]] double x_m(int keyframe) const {
    return window_.keyframes()[keyframe].T_world_key.translation().x();
  }

  RectifiedRig rig_ = test::ideal_rig();
  Arena arena_{1u << 20};
  Window window_;
  TemplatePoints points_;
  std::vector<PointSelector::Candidate> candidates_;
};

TEST_F(AddKeyframe, FillsAWindowFromTheOldestToTheNewest) {
  EXPECT_EQ(window_.capacity(), 3);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(window_.count, k);
    add(20, k);
    EXPECT_EQ(window_.newest().T_world_key.translation().x(), k);
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(x_m(k), k);
}

TEST_F(AddKeyframe, DropsTheOldestWhenTheWindowIsFull) {
  for (int k = 0; k < 7; ++k) add(20 + k, k);
  EXPECT_EQ(window_.count, 3);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(x_m(k), 4 + k);
    EXPECT_EQ(window_.keyframes()[k].points.count, 24 + k);
  }
}

TEST_F(AddKeyframe, GivesEveryKeyframeMemoryOfItsOwn) {
  for (int k = 0; k < 5; ++k) add(20, k);
  std::set<const float*> arrays;
  for (const WindowKeyframe& keyframe : window_.keyframes()) {
    arrays.insert({keyframe.points.x, keyframe.stereo_depth, keyframe.stereo_information,
                   keyframe.information, keyframe.inlier_ratio});
    for (int later = 0; later < window_.capacity() - 1; ++later) {
      const WindowView& view = keyframe.views[later];
      arrays.insert({view.depth, view.residuals.bx, view.residuals.by, view.residuals.squares});
    }
  }
  EXPECT_EQ(arrays.size(), 3u * (5 + 2 * 4));
  EXPECT_FALSE(arrays.contains(nullptr));
}

TEST_F(AddKeyframe, KeepsAllPointsWhenThereIsRoom) {
  add(kCapacity);
  ASSERT_EQ(window_.newest().points.count, kCapacity);
  for (int i = 0; i < kCapacity; ++i) ASSERT_EQ(window_.newest().points.x[i], i);
}

TEST_F(AddKeyframe, TakesAnEvenShareOfTooManyPoints) {
  for (const int count : {51, 75, 100, 149, 200}) {
    add(count);
    const TemplatePoints& kept = window_.newest().points;
    ASSERT_EQ(kept.count, kCapacity);
    EXPECT_EQ(kept.x[0], 0.0f);
    for (int n = 1; n < kept.count; ++n) {
      const float step = kept.x[n] - kept.x[n - 1];
      ASSERT_GE(step, float(count / kCapacity)) << count;
      ASSERT_LE(step, float((count + kCapacity - 1) / kCapacity)) << count;
    }
    EXPECT_GE(kept.x[kCapacity - 1], float(count - count / kCapacity - 1));
  }
}

TEST_F(AddKeyframe, KeepsWhatBelongsToAPointTogether) {
  add(130);
  const WindowKeyframe& keyframe = window_.newest();
  for (int n = 0; n < keyframe.points.count; ++n) {
    const float number = keyframe.points.x[n];
    ASSERT_EQ(keyframe.points.y[n], number + 1000.0f);
    ASSERT_EQ(keyframe.points.inverse_depth_focal[n], number + 2000.0f);
    ASSERT_EQ(keyframe.points.Sxx[n], number + 3000.0f);
    ASSERT_EQ(keyframe.points.Sxy[n], number + 4000.0f);
    ASSERT_EQ(keyframe.points.Syy[n], number + 5000.0f);
    ASSERT_EQ(float(keyframe.points.patches[n].gx2[0]), number);
    ASSERT_FLOAT_EQ(keyframe.stereo_depth[n], (number + 6000.0f) / float(rig_.baseline_m));
  }
}

// e = (b (s - s_stereo))² / (8 var).
TEST_F(AddKeyframe, KnowsADepthAsWellAsItsDisparity) {
  add(130);
  const WindowKeyframe& keyframe = window_.newest();
  for (int n = 0; n < keyframe.points.count; ++n) {
    const double variance_px2 = double(keyframe.points.x[n]) + 1.0;
    const double expected = rig_.baseline_m * rig_.baseline_m / (8.0 * variance_px2);
    ASSERT_NEAR(keyframe.stereo_information[n], expected, 1e-6 * expected);
    ASSERT_EQ(keyframe.information[n], keyframe.stereo_information[n]);
    ASSERT_EQ(keyframe.inlier_ratio[n], 0.5f);
  }
}

TEST_F(AddKeyframe, HasSeenNothingYetEvenWhereAnotherKeyframeWasBefore) {
  for (int k = 0; k < 3; ++k) add(20);
  for (WindowKeyframe& keyframe : window_.keyframes()) {
    for (WindowView& view : keyframe.views) view.visible_count = 20;
  }
  add(20);
  for (const WindowView& view : window_.newest().views) EXPECT_EQ(view.visible_count, 0);
  EXPECT_EQ(window_.keyframes()[0].views[0].visible_count, 20);
}

TEST_F(AddKeyframe, TakesAKeyframeWithoutPoints) {
  add(0);
  EXPECT_EQ(window_.count, 1);
  EXPECT_EQ(window_.newest().points.count, 0);
}

}  // namespace
}  // namespace darkling
