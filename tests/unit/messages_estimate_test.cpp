// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "io/messages.h"

namespace darkling {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kEpochOffset = seconds(1'700'000'000);

Estimate estimate_at(std::int64_t sequence) {
  Estimate e;
  e.sequence = sequence;
  e.stamp = FrameTime(milliseconds(100 * sequence));
  e.status = TrackStatus::kValid;
  e.quality = 80;
  e.reset_counter = 2;
  e.T_world_body = Se3(Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), Vector3(1.0, 2.0, 3.0));
  return e;
}

TEST(EstimateMessages, CarryWhatTheEstimateSays) {
  Estimate e = estimate_at(7);
  e.reasons = kReasonNoDepth | kReasonLowOverlap;
  e.T_previous_body = Se3(Eigen::Quaterniond::Identity(), Vector3(0.25, 0.0, -0.5));
  for (int i = 0; i < 36; ++i) e.cov_previous_body(i / 6, i % 6) = i;
  for (int i = 0; i < 36; ++i) e.cov_world_body(i / 6, i % 6) = 100 + i;
  EstimateMessages messages;
  messages.fill(e, kEpochOffset);
  const update_t& update = messages.update();
  EXPECT_EQ(update.utime, 1'700'000'000'700'000);
  EXPECT_EQ(update.mono_ns, 700'000'000);
  EXPECT_EQ(update.seq, 7);
  EXPECT_EQ(update.reset_counter, 2);
  EXPECT_EQ(update.status, update_t::STATUS_VALID);
  EXPECT_EQ(update.quality, 80);
  EXPECT_EQ(update.reasons, int{update_t::REASON_NO_DEPTH} | int{update_t::REASON_LOW_OVERLAP});
  EXPECT_EQ(update.translation[2], -0.5);
  EXPECT_EQ(update.rotation[0], 1.0);
  EXPECT_EQ(update.covariance[9], 9.0);
  const pose_t& pose = messages.pose();
  EXPECT_EQ(pose.utime, update.utime);
  EXPECT_EQ(pose.translation[1], 2.0);
  EXPECT_EQ(pose.rotation[0], 0.0);
  EXPECT_EQ(pose.rotation[1], 1.0);
  EXPECT_EQ(pose.covariance[35], 135.0);
}

TEST(EstimateMessages, ChainByTheTimeOfTheMessageBefore) {
  EstimateMessages messages;
  messages.fill(estimate_at(0), kEpochOffset);
  EXPECT_EQ(messages.update().prev_utime, 0);
  const std::int64_t first = messages.update().utime;
  messages.fill(estimate_at(1), kEpochOffset + seconds(3600));  // the wall clock was set
  EXPECT_EQ(messages.update().prev_utime, first);
}

TEST(EstimateMessages, GiveTheMeanVelocityInBody) {
  EstimateMessages messages;
  messages.fill(estimate_at(0), kEpochOffset);
  EXPECT_TRUE(std::isnan(messages.pose().velocity[0]));
  Vector6 twist;
  twist << 1.0, 0.5, -0.25, 0.1, -0.2, 0.3;  // per second
  Estimate e = estimate_at(2);
  e.T_previous_body = Se3::exp(0.2 * twist);
  messages.fill(e, kEpochOffset + seconds(3600));
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(messages.pose().velocity[i], twist(i), 1e-12);
    EXPECT_NEAR(messages.pose().angular_velocity[i], twist(3 + i), 1e-12);
  }
}

TEST(EstimateMessages, GiveNoVelocityThatIsNotMeasured) {
  EstimateMessages messages;
  messages.fill(estimate_at(1), kEpochOffset);
  Estimate lost = estimate_at(2);
  lost.status = TrackStatus::kLost;
  Estimate after = estimate_at(3);  // measured, but not since the one before
  after.cov_previous_body = 9999.0 * Matrix6::Identity();
  const Estimate back = estimate_at(3);  // its stamp repeats
  for (const Estimate& e : {lost, after, back}) {
    messages.fill(e, kEpochOffset);
    EXPECT_TRUE(std::isnan(messages.pose().velocity[0]));
    EXPECT_TRUE(std::isnan(messages.pose().angular_velocity[2]));
  }
  messages.fill(estimate_at(4), kEpochOffset);
  EXPECT_FALSE(std::isnan(messages.pose().velocity[0]));
}

}  // namespace
}  // namespace darkling
