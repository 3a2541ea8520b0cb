// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "app/service/health.h"
#include "app/service/latency.h"
#include "app/service/wall_clock.h"

namespace darkling {
namespace {

using std::chrono::milliseconds;
using Camera = Health::Camera;

constexpr Duration kPeriod = milliseconds(50);

MonotonicTime at(int ms) {
  return MonotonicTime(milliseconds(ms));
}

Estimate with_status(TrackStatus status, std::uint32_t reasons = kReasonNone) {
  Estimate estimate;
  estimate.status = status;
  estimate.reasons = reasons;
  return estimate;
}

TEST(Health, FollowsWhatTheLastEstimateSays) {
  Health health(at(0), kPeriod);
  EXPECT_EQ(health.judge(at(10), Camera::kOpen, true), ServiceState::kInit);
  const std::pair<TrackStatus, ServiceState> cases[] = {
      {TrackStatus::kValid, ServiceState::kTracking},
      {TrackStatus::kDegraded, ServiceState::kDegraded},
      {TrackStatus::kLost, ServiceState::kLost}};
  int now_ms = 20;
  for (const auto& [status, state] : cases) {
    health.observe(with_status(status), at(now_ms += 10));
    EXPECT_EQ(health.judge(at(now_ms), Camera::kOpen, true), state);
  }
}

TEST(Health, CallsTheCameraGoneAfterHalfASecondOfSilence) {
  Health health(at(0), kPeriod);
  health.observe(with_status(TrackStatus::kValid), at(100));
  EXPECT_EQ(health.judge(at(600), Camera::kOpen, true), ServiceState::kTracking);
  EXPECT_EQ(health.judge(at(601), Camera::kOpen, true), ServiceState::kNoCamera);
  EXPECT_EQ(health.take_reasons(), kReasonNoFrames);
}

TEST(Health, AllowsASlowCameraFivePeriods) {
  Health health(at(0), milliseconds(1000));
  health.observe(with_status(TrackStatus::kValid), at(0));
  EXPECT_EQ(health.judge(at(5000), Camera::kOpen, true), ServiceState::kTracking);
  EXPECT_EQ(health.judge(at(5001), Camera::kOpen, true), ServiceState::kNoCamera);
}

TEST(Health, WaitsForACameraThatIsBeingOpened) {
  Health health(at(0), kPeriod);
  EXPECT_EQ(health.judge(at(8000), Camera::kOpening, true), ServiceState::kInit);
  EXPECT_EQ(health.judge(at(8100), Camera::kOpen, true), ServiceState::kInit);
  EXPECT_EQ(health.judge(at(8200), Camera::kAbsent, true), ServiceState::kNoCamera);
}

TEST(Health, PutsAHangingThreadAboveEverything) {
  Health health(at(0), kPeriod);
  health.observe(with_status(TrackStatus::kValid), at(10));
  EXPECT_EQ(health.judge(at(20), Camera::kOpen, false), ServiceState::kFault);
  EXPECT_EQ(health.judge(at(20), Camera::kAbsent, false), ServiceState::kFault);
}

TEST(Health, GathersReasonsUntilTheyAreTaken) {
  Health health(at(0), kPeriod);
  health.observe(with_status(TrackStatus::kDegraded, kReasonResidualHigh), at(10));
  health.observe(with_status(TrackStatus::kValid), at(20));
  health.observe(kReasonLate);
  EXPECT_EQ(health.take_reasons(), std::uint32_t{kReasonResidualHigh} | kReasonLate);
  EXPECT_EQ(health.take_reasons(), 0U);
}

TEST(Health, NamesStatesAndReasons) {
  EXPECT_STREQ(name_of(ServiceState::kNoCamera), "NO_CAMERA");
  EXPECT_EQ(describe_reasons(0), "none");
  EXPECT_EQ(describe_reasons(std::uint32_t{kReasonResidualHigh} | kReasonLate),
            "residual_high,late");
}

TEST(WallClock, CountsStepsAndNotDrift) {
  WallClock clock;
  const auto epoch = [](int ms) { return EpochTime(milliseconds(1'000'000 + ms)); };
  EXPECT_EQ(clock.update(at(0), epoch(0)), milliseconds(1'000'000));
  clock.update(at(1000), epoch(1050));  // slewed
  clock.update(at(2000), epoch(2100));
  EXPECT_EQ(clock.steps(), 0);
  clock.update(at(3000), epoch(90'000));
  EXPECT_EQ(clock.steps(), 1);
  clock.update(at(4000), epoch(4000));
  EXPECT_EQ(clock.steps(), 2);
}

TEST(Latency, KnowsMedianAndMost) {
  Latency latency;
  EXPECT_TRUE(latency.is_empty());
  for (const int ms : {9, 1, 5}) latency.add(milliseconds(ms));
  EXPECT_EQ(latency.median(), milliseconds(5));
  EXPECT_EQ(latency.most(), milliseconds(9));
  latency.clear();
  EXPECT_TRUE(latency.is_empty());
  for (int i = 0; i < 1000; ++i) latency.add(milliseconds(i));
  EXPECT_EQ(latency.most(), milliseconds(999));
}

}  // namespace
}  // namespace darkling
