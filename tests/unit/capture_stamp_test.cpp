// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/capture_stamp.h"

#include <gtest/gtest.h>

#include "drivers/camera/arrival_stamps.h"

namespace darkling::test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr std::uint32_t kEndOfFrame = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
constexpr std::uint32_t kStart = kEndOfFrame | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
constexpr MonotonicTime kArrival{std::chrono::seconds(100)};
constexpr Duration kPeriod = milliseconds(50);

v4l2_buffer stamped(std::uint32_t flags, std::int64_t seconds, std::int64_t us) {
  v4l2_buffer buffer = {};
  buffer.flags = flags;
  buffer.timestamp.tv_sec = static_cast<time_t>(seconds);
  buffer.timestamp.tv_usec = static_cast<suseconds_t>(us);
  return buffer;
}

Duration middle(const CaptureStamp& stamp) {
  return stamp.middle.time_since_epoch();
}

TEST(StampCapture, AddsHalfTheExposureToItsStart) {
  const CaptureStamp stamp = stamp_capture(stamped(kStart, 99, 950'000), kArrival, 10.0);
  EXPECT_EQ(middle(stamp), milliseconds(99'955));
  EXPECT_EQ(stamp.source, StampSource::kStartOfExposure);
}

TEST(StampCapture, TakesHalfTheExposureFromTheEndOfTheFrame) {
  const CaptureStamp stamp = stamp_capture(stamped(kEndOfFrame, 99, 950'000), kArrival, 10.0);
  EXPECT_EQ(middle(stamp), milliseconds(99'945));
  EXPECT_EQ(stamp.source, StampSource::kEndOfFrame);
}

TEST(StampCapture, LeavesTheStampWhenTheExposureIsNotKnown) {
  EXPECT_EQ(middle(stamp_capture(stamped(kStart, 99, 950'000), kArrival, -1.0)),
            milliseconds(99'950));
}

TEST(StampCapture, TakesTheArrivalForWantOfAMonotonicClock) {
  for (const std::uint32_t flags :
       {V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, V4L2_BUF_FLAG_TIMESTAMP_COPY, 0x0000e000}) {
    const CaptureStamp stamp =
        stamp_capture(stamped(static_cast<std::uint32_t>(flags), 1'700'000'000, 0), kArrival, 10.0);
    EXPECT_EQ(middle(stamp), milliseconds(99'995));
    EXPECT_EQ(stamp.source, StampSource::kArrival);
  }
}

TEST(StampCapture, TakesTheArrivalForStampsThatCannotBe) {
  for (const auto& buffer :
       {stamped(kStart, 0, 0), stamped(kStart, -1, 0), stamped(kStart, 1'700'000'000, 0),
        stamped(kStart, INT32_MAX, 999'999), stamped(kStart, 99, -1),
        stamped(kStart, 99, 1'000'000), stamped(kStart, 102, 0)}) {
    const CaptureStamp stamp = stamp_capture(buffer, kArrival, 0.0);
    EXPECT_EQ(stamp.source, StampSource::kArrival);
    EXPECT_EQ(middle(stamp), std::chrono::seconds(100));
  }
}

TEST(StampCapture, BelievesStampsThatAreAheadByTheClocksGrainAndNoMore) {
  for (const std::uint32_t flags : {kStart, kEndOfFrame}) {
    const CaptureStamp grain = stamp_capture(stamped(flags, 100, 1'000), kArrival, 0.0);
    EXPECT_FALSE(grain.is_of_future);
    EXPECT_EQ(middle(grain), milliseconds(100'001));
    for (const v4l2_buffer& buffer : {stamped(flags, 100, 1'001), stamped(flags, 100, 400'000),
                                      stamped(flags, 3'700, 0), stamped(flags, INT32_MAX, 0)}) {
      const CaptureStamp ahead = stamp_capture(buffer, kArrival, 10.0);
      EXPECT_TRUE(ahead.is_of_future);
      EXPECT_EQ(ahead.source, StampSource::kArrival);
      EXPECT_EQ(middle(ahead), milliseconds(99'995));
    }
  }
}

TEST(StampCapture, DoesNotTakeAnotherClockForTheFuture) {
  EXPECT_FALSE(
      stamp_capture(stamped(V4L2_BUF_FLAG_TIMESTAMP_COPY, 3'700, 0), kArrival, 10.0).is_of_future);
  EXPECT_FALSE(stamp_capture(stamped(kStart, 99, -1), kArrival, 10.0).is_of_future);
}

TEST(ArrivalStamps, GoByWhatTheLastGoodFrameTookToArrive) {
  const FrameTime arrival{std::chrono::seconds(100)};
  ArrivalStamps stamps;
  EXPECT_EQ(stamps.estimate(arrival, arrival - kPeriod), arrival - kPeriod);
  EXPECT_EQ(stamps.note(arrival - milliseconds(30), arrival), arrival - milliseconds(30));
  EXPECT_EQ(stamps.estimate(arrival + kPeriod, arrival), arrival + milliseconds(20));
}

TEST(ArrivalStamps, AreNeverLaterThanTheArrivalAndLearnNothingFromWhatIs) {
  const FrameTime arrival{std::chrono::seconds(100)};
  ArrivalStamps stamps;
  static_cast<void>(stamps.note(arrival - milliseconds(30), arrival));
  EXPECT_EQ(stamps.note(arrival + milliseconds(8), arrival), arrival);
  EXPECT_EQ(stamps.note(arrival - std::chrono::hours(1), arrival), arrival - std::chrono::hours(1));
  EXPECT_EQ(stamps.estimate(arrival, arrival), arrival - milliseconds(30));
}

TEST(StampUncertainty, IsTheUnitOfAFixedExposure) {
  EXPECT_EQ(stamp_uncertainty(StampSource::kStartOfExposure, 8.0, false, kPeriod),
            microseconds(50));
}

TEST(StampUncertainty, IsHalfAnExposureThatMayHaveChanged) {
  EXPECT_EQ(stamp_uncertainty(StampSource::kStartOfExposure, 8.0, true, kPeriod), milliseconds(4));
}

TEST(StampUncertainty, IsHalfAPeriodWhenTheExposureIsNotKnown) {
  EXPECT_EQ(stamp_uncertainty(StampSource::kStartOfExposure, -1.0, true, kPeriod),
            milliseconds(25));
}

TEST(StampUncertainty, IsTheReadoutsMostAtTheEndOfAFrame) {
  EXPECT_EQ(stamp_uncertainty(StampSource::kEndOfFrame, 8.0, false, kPeriod), kPeriod);
}

TEST(StampUncertainty, IsNotKnownOfArrivals) {
  EXPECT_EQ(stamp_uncertainty(StampSource::kArrival, 8.0, false, kPeriod), Duration::zero());
}

}  // namespace
}  // namespace darkling::test
