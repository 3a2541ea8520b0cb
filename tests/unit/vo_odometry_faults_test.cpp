// SPDX-License-Identifier: Apache-2.0
// What the odometry says of images and motions that are not as they should be, and goes on.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "app/service/follow_pair.h"
#include "support/synthetic_run.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::KeptFrame;
using test::SyntheticRun;

constexpr char kQuarry[] = "quarry,frames=40,width=160,seed=2";
constexpr std::uint32_t kFaults =
    kReasonTorn | kReasonBlur | kReasonStepTooLarge | kReasonUnsynced | kReasonFrozen;

std::vector<Estimate> track_all(const SyntheticRun& run, const std::vector<KeptFrame>& frames) {
  const auto odometry =
      Odometry::create({.width_px = 160}, run.rig, KernelTable(), [] { return MonotonicTime(); });
  EXPECT_TRUE(odometry);
  std::vector<Estimate> estimates;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    estimates.push_back((*odometry)->track(frames[i].at(static_cast<std::int64_t>(i))));
  }
  return estimates;
}

// The lower half is still that of the frame before.
KeptFrame torn(const KeptFrame& frame, const KeptFrame& before) {
  KeptFrame spoilt = frame;
  const auto half = static_cast<std::ptrdiff_t>(frame.left.size() / 2);
  std::copy(before.left.begin() + half, before.left.end(), spoilt.left.begin() + half);
  return spoilt;
}

// Smeared along its rows, over 8 px.
KeptFrame smeared(const KeptFrame& frame) {
  KeptFrame spoilt = frame;
  for (std::vector<std::uint8_t>* eye : {&spoilt.left, &spoilt.right}) {
    const std::vector<std::uint8_t> sharp = *eye;
    for (std::size_t i = 7; i < sharp.size(); ++i) {
      int sum = 0;
      for (std::size_t k = 0; k < 8; ++k) sum += sharp[i - k];
      (*eye)[i] = static_cast<std::uint8_t>(sum / 8);
    }
  }
  return spoilt;
}

TEST(Odometry, FindsNoFaultInASoundRun) {
  const SyntheticRun& run = test::synthetic_run(kQuarry);
  for (const Estimate& estimate : track_all(run, run.frames)) {
    EXPECT_EQ(estimate.reasons & kFaults, 0u) << estimate.sequence;
  }
}

TEST(Odometry, LosesATornImageAndDoubtsThoseThatFollow) {
  const SyntheticRun& run = test::synthetic_run(kQuarry);
  std::vector<KeptFrame> frames = run.frames;
  frames[10] = torn(run.frames[10], run.frames[9]);
  const std::vector<Estimate> estimates = track_all(run, frames);
  EXPECT_EQ(estimates[9].status, TrackStatus::kValid);
  EXPECT_EQ(estimates[10].status, TrackStatus::kLost);
  EXPECT_EQ(estimates[10].reasons, kReasonTorn);
  EXPECT_FALSE(estimates[10].is_keyframe);
  for (const std::size_t i : {11u, 30u}) {
    EXPECT_EQ(estimates[i].status, TrackStatus::kDegraded) << i;
    EXPECT_EQ(estimates[i].reasons, kReasonTorn) << i;
    EXPECT_LT(minus(estimates[i].T_world_body, run.T_world_body[i]).head<3>().norm(), 0.03) << i;
  }
  EXPECT_EQ(estimates[31].status, TrackStatus::kValid);
}

TEST(Odometry, NamesBlurWhereFramesBeforeWereSharp) {
  const SyntheticRun& run = test::synthetic_run(kQuarry);
  std::vector<KeptFrame> frames = run.frames;
  frames[10] = smeared(run.frames[10]);
  const std::vector<Estimate> estimates = track_all(run, frames);
  EXPECT_EQ(estimates[10].status, TrackStatus::kDegraded);
  EXPECT_EQ(estimates[10].reasons & kReasonBlur, kReasonBlur);
  EXPECT_EQ(estimates[11].reasons & kReasonBlur, 0u);
}

// As if the vehicle had been pushed: six steps at once, of which no gap in the numbers tells.
TEST(Odometry, DoubtsAStepThatNoVehicleMakes) {
  const SyntheticRun& run = test::synthetic_run(kQuarry);
  std::vector<KeptFrame> frames(run.frames.begin(), run.frames.begin() + 20);
  frames.insert(frames.end(), run.frames.begin() + 26, run.frames.end());
  const std::vector<Estimate> estimates = track_all(run, frames);
  EXPECT_EQ(estimates[20].reasons & kReasonStepTooLarge, kReasonStepTooLarge);
  EXPECT_EQ(estimates[20].status, TrackStatus::kDegraded);
  const Se3 T_step = run.T_world_body[19].inverse() * run.T_world_body[26];
  EXPECT_LT(minus(estimates[20].T_previous_body, T_step).head<3>().norm(), 0.03);
}

TEST(FollowPair, SaysWhyAPairIsMissing) {
  const SyntheticRun& run = test::synthetic_run(kQuarry);
  const auto odometry =
      Odometry::create({.width_px = 160}, run.rig, KernelTable(), [] { return MonotonicTime(); });
  ASSERT_TRUE(odometry);
  const auto reasons_of = [&](FrameFault fault) {
    return follow_pair(**odometry, {.status = WaitStatus::kBadFrame, .fault = fault}).reasons;
  };
  EXPECT_EQ(reasons_of(FrameFault::kUnpaired), kReasonUnsynced);
  EXPECT_EQ(reasons_of(FrameFault::kUnreadable), kReasonDropped);
  EXPECT_EQ(reasons_of(FrameFault::kWrongSize), kReasonDropped);
}

}  // namespace
}  // namespace darkling
