// SPDX-License-Identifier: Apache-2.0
// The way back to a place that was seen before.
#include <gtest/gtest.h>

#include "support/synthetic_run.h"
#include "vo/covariance.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::KeptFrame;
using test::SyntheticRun;

constexpr char kCorridor[] = "corridor,frames=60,width=160,seed=2";
constexpr char kElsewhere[] = "quarry,frames=6,width=160,seed=3";

MonotonicTime stopped_clock() {
  return MonotonicTime();
}

// Plays frames of the corridor in any order.
class Recovery : public ::testing::Test {
 protected:
  Estimate track(const KeptFrame& frame) { return odometry_->track(frame.at(sequence_++)); }
  Estimate go_to(int frame) { return track(run_.frames[static_cast<std::size_t>(frame)]); }
  void drive(int first, int last) {
    for (int i = first; i < last; ++i) (void)go_to(i);
  }
  void go_dark(int frames) {
    const KeptFrame dark = test::flat_frame(run_.frames[0], 0);
    for (int i = 0; i < frames; ++i) (void)track(dark);
  }
  // To a place that the ring does not hold, where a new track begins.
  void go_elsewhere() {
    for (const KeptFrame& frame : test::synthetic_run(kElsewhere).frames) (void)track(frame);
  }
  [[nodiscard]] double error_m(const Estimate& estimate, int frame) const {
    return (estimate.T_world_body.translation() -
            run_.T_world_body[static_cast<std::size_t>(frame)].translation())
        .norm();
  }

  const SyntheticRun& run_ = test::synthetic_run(kCorridor);
  std::unique_ptr<Odometry> odometry_ =
      std::move(*Odometry::create({.width_px = 160}, run_.rig, {}, stopped_clock));
  std::int64_t sequence_ = 0;
};

// What a frame says that was found in the ring.
void expect_found(const Estimate& found) {
  EXPECT_EQ(found.status, TrackStatus::kLost) << "the motion to it is not known";
  EXPECT_EQ(found.quality, -1);
  EXPECT_TRUE(found.is_keyframe);
  EXPECT_EQ(found.cov_previous_body, unknown_covariance());
  EXPECT_TRUE(found.T_previous_body.matrix().isIdentity(1e-12));
  EXPECT_TRUE(is_known(found.cov_world_body));
}

TEST_F(Recovery, ComesBackToAPlaceFromBeforeTheDark) {
  drive(0, 50);
  go_dark(14);
  const Estimate found = go_to(3);
  expect_found(found);
  EXPECT_EQ(found.reset_counter, 1);
  EXPECT_LT(error_m(found, 3), 0.005);
  const Estimate next = go_to(4);
  EXPECT_EQ(next.status, TrackStatus::kValid) << next.reasons;
  EXPECT_TRUE(is_known(next.cov_previous_body));
  EXPECT_LT(error_m(next, 4), 0.005);
  EXPECT_EQ(next.reset_counter, 1);
}

TEST_F(Recovery, KnowsAFoundPoseAsWellAsItsKeyframe) {
  drive(0, 49);
  const double before = go_to(49).cov_world_body.trace();
  go_dark(14);
  const double after = go_to(3).cov_world_body.trace();
  EXPECT_GT(after, 0.0);
  EXPECT_LT(after, before) << "it is near the start, where less was driven";
}

TEST_F(Recovery, ComesBackFromAnotherPlace) {
  drive(0, 24);
  go_elsewhere();
  const Estimate found = go_to(10);
  expect_found(found);
  EXPECT_EQ(found.reset_counter, 2);
  EXPECT_LT(error_m(found, 10), 0.01);
}

TEST_F(Recovery, JoinsTheOldTrackOnTheWayBack) {
  drive(0, 16);
  go_dark(12);
  drive(55, 58);  // out of sight of the ring: a new track
  Estimate estimate = go_to(58);
  EXPECT_EQ(estimate.status, TrackStatus::kValid) << estimate.reasons;
  EXPECT_EQ(estimate.reset_counter, 1);
  EXPECT_GT(error_m(estimate, 58), 0.5) << "it does not know where it is";
  for (int i = 57; i >= 10; --i) {
    const int resets = estimate.reset_counter;
    estimate = go_to(i);
    ASSERT_LE(estimate.status, TrackStatus::kDegraded) << i;
    const Se3 T_true = run_.T_world_body[i + 1].inverse() * run_.T_world_body[i];
    EXPECT_LT(minus(estimate.T_previous_body, T_true).norm(), 0.01) << "a jump is no motion " << i;
    EXPECT_TRUE(is_known(estimate.cov_previous_body)) << i;
    if (estimate.reset_counter > resets) {
      EXPECT_LT(error_m(estimate, i), 0.02) << i;
    }
  }
  EXPECT_EQ(estimate.reset_counter, 2);
  EXPECT_LT(error_m(estimate, 10), 0.02);
}

TEST_F(Recovery, ForgetsAllPlacesAtAReset) {
  drive(0, 10);
  odometry_->reset();
  go_elsewhere();
  const Estimate estimate = go_to(5);
  EXPECT_EQ(estimate.status, TrackStatus::kLost);
  EXPECT_FALSE(estimate.is_keyframe);
  EXPECT_EQ(estimate.cov_world_body, unknown_covariance());
}

TEST_F(Recovery, RemembersPlacesAcrossAReseed) {
  drive(0, 10);
  odometry_->reseed();
  (void)go_to(10);
  go_elsewhere();
  EXPECT_LT(error_m(go_to(5), 5), 0.005);
}

}  // namespace
}  // namespace darkling
