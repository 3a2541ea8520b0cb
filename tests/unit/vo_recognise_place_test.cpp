// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "support/kernel_cases.h"
#include "support/vo_stages.h"
#include "vo/recognise_place.h"

namespace darkling {
namespace {

constexpr int kLevels = 3;
constexpr int kAnyTrack = 1000;

Se3 motion(double x, double y, double z, double rx, double ry, double rz) {
  Vector6 xi;
  xi << x, y, z, rx, ry, rz;
  return Se3::exp(xi);
}

// A ring with keyframes of a world of wall and floor.
class RecognisePlace : public ::testing::Test {
 protected:
  RecognisePlace() { allocate_ring(kLevels, kPoints, arena_, ring_); }

  // @param T_told  where the keyframe is said to be.
  void remember(const Se3& T_world_key, const Se3& T_told, int track = 0) {
    look(world_, T_world_key);
    stages_.know_disparities(world_, T_world_key);
    stages_.build(kernels_, eye_.pyramid());
    add_to_ring(track, T_told, {}, stages_.keyframe(), ring_);
  }
  void look(const test::PlaneWorld& world, const Se3& T_world_left) {
    world.render(rig_, T_world_left, eye_.grey());
    eye_.prepare(kernels_);
  }
  [[nodiscard]] std::optional<Recognition> recognise(int before_track = kAnyTrack) const {
    return recognise_place(kernels_, ring_, before_track, eye_.pyramid(), stages_.residuals());
  }
  [[nodiscard]] RotationMatch match(const KernelTable& kernels) const {
    RotationMatch found;
    found.keyframe = &ring_.slots[0];
    search_rotations(kernels, eye_.pyramid(), stages_.residuals(), {&found, 1});
    return found;
  }

  static constexpr int kPoints = 800;
  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::PlaneWorld world_;
  Arena arena_{8u << 20};
  KeyframeRing ring_;
  test::EyeStages eye_{rig_, kLevels};
  test::TemplateStages stages_{rig_, kLevels, kPoints};
};

TEST_F(RecognisePlace, FindsNothingInAnEmptyRing) {
  look(world_, Se3());
  EXPECT_FALSE(recognise());
}

// The law of the search: it undoes any rotation of yaw and pitch that leaves enough in view, to
// within its grid.
TEST_F(RecognisePlace, UndoesRotationsToWithinTheGrid) {
  remember(Se3(), Se3());
  const double px_rad = std::ldexp(1.0, kLevels - 1) / rig_.focal_px;  // of the coarsest level
  for (const double yaw : {-0.35, -0.2, -0.07, 0.0, 0.11, 0.26, 0.4}) {
    for (const double pitch : {-0.15, -0.04, 0.0, 0.12}) {
      const Se3 T_key_current = motion(0, 0, 0, pitch, yaw, 0);
      look(world_, T_key_current);
      const double off_rad = rotation_angle(match(kernels_).T_current_key * T_key_current);
      EXPECT_LT(off_rad, 2.5 * px_rad) << yaw << " " << pitch;
    }
  }
}

TEST_F(RecognisePlace, SearchesAlikeWithEveryKernelTable) {
  remember(Se3(), Se3());
  look(world_, motion(0.1, 0, 0, 0.05, -0.2, 0.02));
  const RotationMatch expected = match(kernels_);
  for (const KernelTable& kernels : test::available_tables()) {
    const RotationMatch found = match(kernels);
    EXPECT_EQ(found.rank, expected.rank) << kernels.name;
    EXPECT_EQ(found.T_current_key.matrix(), expected.T_current_key.matrix()) << kernels.name;
  }
}

TEST_F(RecognisePlace, FindsThePoseOfATurnedAndMovedFrame) {
  remember(Se3(), Se3());
  for (const Se3& T_world_left :
       {motion(0.1, 0.05, 0.2, 0.02, 0.3, 0.05), motion(-0.2, 0.0, 0.3, -0.1, -0.25, -0.08)}) {
    look(world_, T_world_left);
    const std::optional<Recognition> found = recognise();
    ASSERT_TRUE(found);
    const Vector6 off = minus(found->alignment.T_current_key.inverse(), T_world_left);
    EXPECT_LT(off.head<3>().norm(), 0.01);
    EXPECT_LT(off.tail<3>().norm(), 0.002);
  }
}

TEST_F(RecognisePlace, TakesTheKeyframeThatIsNear) {
  for (int i = 0; i < 6; ++i) {
    const Se3 T_world_key = motion(0.8 * i, 0, 0, 0, 0, 0);
    remember(T_world_key, T_world_key);
  }
  look(world_, motion(2.5, 0, 0.1, 0, 0.2, 0));
  const std::optional<Recognition> found = recognise();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->keyframe, &ring_.slots[3]);
}

TEST_F(RecognisePlace, RefusesPlacesThatWereNeverSeen) {
  remember(Se3(), Se3());
  remember(motion(0.3, 0, 0, 0, 0, 0), motion(0.3, 0, 0, 0, 0, 0));
  for (std::uint64_t seed = 2; seed < 42; ++seed) {
    look(test::PlaneWorld({.seed = seed}), Se3());
    EXPECT_FALSE(recognise()) << seed;
  }
}

TEST_F(RecognisePlace, RefusesKeyframesThatContradictEachOther) {
  remember(Se3(), Se3());
  remember(motion(0.1, 0, 0, 0, 0, 0), motion(0.1, 0, 0, 0, 0, 0));
  look(world_, motion(0.05, 0, 0, 0, 0, 0));
  EXPECT_TRUE(recognise());
  ring_.slots[1].T_world_key = motion(1.0, 0, 0, 0, 0, 0);
  EXPECT_FALSE(recognise());
}

TEST_F(RecognisePlace, PrefersTheOldestTrackAndLeavesOutWhatItIsTold) {
  remember(motion(0.1, 0, 0, 0, 0, 0), Se3(), /*track=*/2);
  remember(Se3(), Se3(), /*track=*/5);
  look(world_, Se3());
  ASSERT_TRUE(recognise());
  EXPECT_EQ(recognise()->keyframe->track, 2) << "though the other lies on it exactly";
  EXPECT_EQ(recognise(5)->keyframe->track, 2);
  EXPECT_FALSE(recognise(2));
}

}  // namespace
}  // namespace darkling
