// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <gmock/gmock.h>

#include "support/plane_world.h"
#include "vo/keyframe_ring.h"

namespace darkling {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

Se3 at_x(double x_m) {
  return {Matrix3(Matrix3::Identity()), Vector3(x_m, 0.0, 0.0)};
}

// Keyframes that are told apart by where they are along x.
class AddToRing : public ::testing::Test {
 protected:
  AddToRing() { allocate_ring(kLevels, kPoints, arena_, ring_); }

  void add(int track, double x_m, int point_count = 0) {
    for (TemplateLevel& level : points_.levels) {
      TemplatePoints& points = level.points;
      points.count = std::min(point_count, level.capacity);
      for (int i = 0; i < points.count; ++i) {
        points.x[i] = static_cast<float>(i);
        points.patches[i].gx2[0] = static_cast<std::int16_t>(i);
      }
      level.mean_inverse_depth_focal = 7.0f;
    }
    PoseCovariance::Accumulated covariance;
    covariance.scale_m.x() = x_m;
    add_to_ring(track, at_x(x_m), covariance, points_, ring_);
  }
  void add_many(int track, int first, int count) {
    for (int i = 0; i < count; ++i) add(track, first + i);
  }
  [[nodiscard]] std::vector<double> places() const {
    std::vector<double> x_m;
    for (const RingKeyframe& key : ring_.keyframes()) {
      x_m.push_back(key.T_world_key.translation().x());
    }
    return x_m;
  }
  [[nodiscard]] int count_of(int track) const {
    int count = 0;
    for (const RingKeyframe& key : ring_.keyframes()) count += key.track == track ? 1 : 0;
    return count;
  }

  static constexpr int kLevels = 3;
  static constexpr int kPoints = 2000;
  Arena arena_{8u << 20};
  KeyframeRing ring_;
  KeyframeTemplate points_ = allocate_template(kLevels, kPoints, arena_);
};

TEST_F(AddToRing, KeepsTheLastKeyframesInOrder) {
  add_many(0, 0, 3);
  EXPECT_THAT(places(), ElementsAre(0.0, 1.0, 2.0));
  add_many(0, 3, 2 * kRingKeyframes);
  std::vector<double> last;
  for (int i = 0; i < kRingKeyframes; ++i) last.push_back(3 + kRingKeyframes + i);
  EXPECT_THAT(places(), ElementsAreArray(last));
  EXPECT_EQ(ring_.newest().covariance.scale_m.x(), last.back());
}

TEST_F(AddToRing, TakesPointsEvenlyUpToItsCapacity) {
  add(0, 0.0, 2 * kRingPoints);
  const KeyframeTemplate& kept = ring_.newest().points;
  ASSERT_EQ(kept.levels.size(), 3u);
  EXPECT_EQ(kept.levels[0].points.count, kRingPoints);
  EXPECT_EQ(kept.levels[0].mean_inverse_depth_focal, 7.0f);
  for (int i = 0; i < kRingPoints; ++i) {
    EXPECT_EQ(kept.levels[0].points.x[i], 2.0f * static_cast<float>(i));
    EXPECT_EQ(kept.levels[0].points.patches[i].gx2[0], 2 * i);
  }
  EXPECT_EQ(kept.levels[1].points.count, kRingCoarsePoints);
  add(0, 1.0, 30);  // and all of them when they are few
  EXPECT_EQ(ring_.newest().points.levels[0].points.count, 30);
  EXPECT_EQ(ring_.newest().points.levels[2].points.count, 30);
  EXPECT_EQ(ring_.slots[0].points.levels[0].points.count, kRingPoints) << "memory is shared";
}

TEST_F(AddToRing, KeepsHalfForTheOldestTrack) {
  add_many(0, 0, kRingKeyframes);
  add_many(4, 100, 3 * kRingKeyframes);
  EXPECT_EQ(count_of(0), kRingKeyframes / 2);
  EXPECT_EQ(count_of(4), kRingKeyframes / 2);
  EXPECT_EQ(places().front(), kRingKeyframes / 2) << "of its keyframes the newest";
  add_many(9, 200, 3 * kRingKeyframes);
  EXPECT_EQ(count_of(0), kRingKeyframes / 2);
  EXPECT_EQ(count_of(4), 0);
}

TEST_F(AddToRing, LetsTheOthersGoFirstWhenTheOldestTrackGoesOn) {
  add_many(0, 0, kRingKeyframes);
  add_many(4, 100, kRingKeyframes);
  add_many(0, 200, kRingKeyframes);
  EXPECT_EQ(count_of(4), 0);
  EXPECT_EQ(places().front(), 200.0);
}

TEST_F(AddToRing, FollowsTheRefinementOfItsNewestKeyframes) {
  add_many(0, 0, 4);
  Window window;
  allocate_window(test::ideal_rig(), {}, arena_, window);
  window.count = 2;
  window.slots[0].T_world_key = at_x(2.25);
  window.slots[1].T_world_key = at_x(3.5);
  follow_window(window, ring_);
  EXPECT_THAT(places(), ElementsAre(0.0, 1.0, 2.25, 3.5));
}

TEST_F(AddToRing, MovesATrackThatJoinsAnOlderOne) {
  add_many(0, 0, 2);
  add_many(1, 10, 1);
  add_many(2, 20, 2);
  join_tracks(2, 0, at_x(-15.0), ring_);
  EXPECT_THAT(places(), ElementsAre(0.0, 1.0, 10.0, 5.0, 6.0));
  EXPECT_EQ(count_of(0), 4);
  EXPECT_EQ(count_of(1), 1);
}

}  // namespace
}  // namespace darkling
