// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/kernel_cases.h"
#include "support/synthetic_run.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::SyntheticRun;

constexpr char kCorridor[] = "corridor,frames=12,width=160,seed=2";
constexpr double kRight_m = 0.03;

MonotonicTime stopped_clock() {
  return MonotonicTime();
}

class Commands : public ::testing::Test {
 protected:
  Commands()
      : run_(test::synthetic_run(kCorridor)),
        odometry_(std::move(
            *Odometry::create({.width_px = 160}, run_.rig, KernelTable(), stopped_clock))) {}

  Estimate track(std::int64_t frame) {
    return odometry_->track(run_.frames[static_cast<std::size_t>(frame)].at(frame));
  }

  const SyntheticRun& run_;
  std::unique_ptr<Odometry> odometry_;
};

TEST_F(Commands, ResetStartsANewTrackAtTheOriginAndCountsIt) {
  for (int i = 0; i < 5; ++i) (void)track(i);
  odometry_->reset();
  const Estimate first = track(5);
  EXPECT_EQ(first.reset_counter, 1);
  EXPECT_TRUE(first.is_keyframe);
  EXPECT_EQ(first.status, TrackStatus::kValid);
  EXPECT_LT(first.T_world_body.translation().norm(), 1e-12);
  EXPECT_LT(first.cov_world_body.norm(), 1e-12);
  Estimate last;
  for (int i = 6; i < 12; ++i) last = track(i);
  const Se3 T_start_end = run_.T_world_body[5].inverse() * run_.T_world_body[11];
  EXPECT_EQ(last.status, TrackStatus::kValid);
  EXPECT_LT((last.T_world_body.translation() - T_start_end.translation()).norm(), kRight_m);
}

TEST_F(Commands, ResetGivesTheBytesOfAFreshOdometry) {
  for (int i = 0; i < 5; ++i) (void)track(i);
  odometry_->reset();
  auto fresh = Odometry::create({.width_px = 160}, run_.rig, KernelTable(), stopped_clock);
  ASSERT_TRUE(fresh);
  for (int i = 5; i < 12; ++i) {
    const Estimate again = track(i);
    const Estimate first = (*fresh)->track(run_.frames[static_cast<std::size_t>(i)].at(i));
    EXPECT_EQ(again.T_world_left.matrix(), first.T_world_left.matrix()) << i;
    EXPECT_EQ(again.cov_world_body, first.cov_world_body) << i;
  }
}

TEST_F(Commands, ReseedMakesTheNextFrameAKeyframeOnce) {
  (void)track(0);
  ASSERT_FALSE(track(1).is_keyframe);
  odometry_->reseed();
  EXPECT_TRUE(track(2).is_keyframe);
  EXPECT_FALSE(track(3).is_keyframe);
}

TEST_F(Commands, AHintFindsAMotionThatNoGuessComesNearTo) {
  // The last frame again, turned by a hand: without a hint the guesses are too far away.
  (void)track(0);
  const Estimate before = track(1);
  odometry_->hint(run_.T_world_body[1].inverse() * run_.T_world_body[11]);
  const Estimate hinted = track(11);
  EXPECT_EQ(hinted.status, TrackStatus::kValid);
  EXPECT_LT((hinted.T_world_body.translation() - run_.T_world_body[11].translation()).norm(),
            kRight_m);
  EXPECT_EQ(before.reset_counter, hinted.reset_counter);
}

TEST_F(Commands, AWrongHintDoesNoHarm) {
  for (int i = 0; i < 5; ++i) (void)track(i);
  odometry_->hint(
      Se3(Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Vector3::UnitZ())), Vector3(3.0, -2.0, 1.0)));
  const Estimate estimate = track(5);
  EXPECT_EQ(estimate.status, TrackStatus::kValid);
  EXPECT_LT((estimate.T_world_body.translation() - run_.T_world_body[5].translation()).norm(),
            kRight_m);
}

}  // namespace
}  // namespace darkling
