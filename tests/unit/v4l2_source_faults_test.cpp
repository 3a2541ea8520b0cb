// SPDX-License-Identifier: Apache-2.0
#include <cerrno>

#include "support/two_cameras.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

class V4l2SourceFaults : public TwoCameras {
 protected:
  // Alters the left camera's frame of this number.
  void alter_left(std::uint32_t sequence, const std::function<void(v4l2_buffer&)>& change) {
    left_.alter = [=](v4l2_buffer& buffer) {
      if (buffer.sequence == sequence) change(buffer);
    };
  }
  void share() {
    config_.source = "v4l2:/dev/video0";
    config_.layout = EyeLayout::kSideBySide;
    left_.formats = {{V4L2_PIX_FMT_GREY, 64, 16, 64, 1024}};
  }
  void expect_bad(const WaitResult& result, FrameFault fault, std::int64_t sequence) {
    EXPECT_EQ(result.status, WaitStatus::kBadFrame);
    EXPECT_EQ(result.fault, fault);
    EXPECT_EQ(result.sequence, sequence);
    EXPECT_GT(result.stamp.time_since_epoch(), std::chrono::seconds(999));
  }
};

TEST_F(V4l2SourceFaults, ReportABadSharedBufferInItsPlace) {
  share();
  start();
  alter_left(1, [](v4l2_buffer& buffer) { buffer.flags |= V4L2_BUF_FLAG_ERROR; });
  EXPECT_EQ(next_sequence(), 0);
  expect_bad(next(), FrameFault::kUnreadable, 1);
  EXPECT_EQ(next_sequence(), 2);
  EXPECT_EQ(source_->stats().unreadable, 1);
  EXPECT_EQ(source_->stats().device_errors, 1);
  EXPECT_EQ(source_->stats().delivered, 2);
}

TEST_F(V4l2SourceFaults, ReportTheOtherEyeOfABadBufferAsUnpaired) {
  start();
  alter_left(1, [](v4l2_buffer& buffer) { buffer.bytesused = 3; });
  EXPECT_EQ(next_sequence(), 0);
  expect_bad(next(), FrameFault::kUnpaired, 1);
  EXPECT_EQ(next_sequence(), 2);
  EXPECT_EQ(source_->stats().unpaired, 1);
  EXPECT_EQ(source_->stats().device_errors, 1);
}

TEST_F(V4l2SourceFaults, LeaveAGapWhereTheDeviceLostFrames) {
  share();
  start();
  left_.alter = [](v4l2_buffer& buffer) { buffer.sequence += buffer.sequence > 1 ? 3 : 0; };
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(next_sequence(), 1);
  EXPECT_EQ(next_sequence(), 5);
  EXPECT_EQ(next_sequence(), 6);
  EXPECT_EQ(source_->stats().dropped_by_device, 3);
}

TEST_F(V4l2SourceFaults, CountStampsThatGoBack) {
  share();
  start();
  alter_left(1, [](v4l2_buffer& buffer) { buffer.timestamp.tv_sec -= 10; });
  for (int k = 0; k < 3; ++k) EXPECT_EQ(next_sequence(), k);
  EXPECT_EQ(source_->stats().stamps_not_increasing, 1);
}

TEST_F(V4l2SourceFaults, CountStampsOfTheFutureAndGoOnAtTheSamePace) {
  share();
  left_.exposure = milliseconds(30);  // and a readout of nothing
  start();
  alter_left(2, [](v4l2_buffer& buffer) { buffer.timestamp.tv_sec += 3600; });
  FrameTime before;
  for (int k = 0; k < 5; ++k) {
    const WaitResult result = next();
    ASSERT_EQ(result.status, WaitStatus::kFrame);
    EXPECT_EQ(result.lease.frame().sequence, k);
    const FrameTime stamp = result.lease.frame().stamp;
    EXPECT_EQ(to_ns(system_.now()) - to_ns(stamp), 30'000'000);
    if (k > 0) {
      EXPECT_EQ(stamp - before, milliseconds(50));
    }
    before = stamp;
    EXPECT_EQ(source_->camera_state().stamp_source,
              k == 2 ? StampSource::kArrival : StampSource::kStartOfExposure);
  }
  EXPECT_EQ(source_->stats().stamps_of_future, 1);
  EXPECT_EQ(source_->stats().stamps_not_increasing, 0);
  EXPECT_EQ(source_->stats().device_errors, 0);
}

TEST_F(V4l2SourceFaults, PairAFrameOfTheFutureWithItsOwnPartner) {
  start();
  alter_left(1, [](v4l2_buffer& buffer) { buffer.timestamp.tv_usec += 400'000; });
  for (int k = 0; k < 4; ++k) EXPECT_EQ(next_sequence(), k);
  EXPECT_EQ(source_->stats().stamps_of_future, 1);
  EXPECT_EQ(source_->stats().unpaired, 0);
}

TEST_F(V4l2SourceFaults, StampByArrivalACameraThatIsAlwaysAhead) {
  share();
  start();
  left_.alter = [](v4l2_buffer& buffer) { buffer.timestamp.tv_sec += 1; };
  for (int k = 0; k < 3; ++k) {
    const WaitResult result = next();
    ASSERT_EQ(result.status, WaitStatus::kFrame);
    EXPECT_EQ(result.lease.frame().stamp.time_since_epoch(), system_.now().time_since_epoch());
  }
  EXPECT_EQ(source_->stats().stamps_of_future, 3);
}

TEST_F(V4l2SourceFaults, ReportPairsThatAreTooFarApartOnce) {
  right_.phase = milliseconds(20);
  start();
  for (int k = 0; k < 10; ++k) expect_bad(next(), FrameFault::kUnpaired, k);
  EXPECT_EQ(source_->stats().unpaired, 10);
  EXPECT_EQ(source_->stats().delivered, 0);
}

TEST_F(V4l2SourceFaults, ReportTheFramesOfOneEyeWhileTheOtherStalls) {
  start();
  EXPECT_EQ(next_sequence(), 0);
  right_.is_stalled = true;
  for (int k = 1; k < 5; ++k) expect_bad(next(), FrameFault::kUnpaired, k);
  right_.is_stalled = false;
  std::int64_t sequence = -1;
  for (int k = 0; k < 10 && sequence < 0; ++k) sequence = next_sequence();
  EXPECT_GE(sequence, 5);
}

TEST_F(V4l2SourceFaults, StampByArrivalWhatHasNoClock) {
  share();
  left_.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  start();
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  EXPECT_EQ(result.lease.frame().stamp.time_since_epoch(), system_.now().time_since_epoch());
  EXPECT_EQ(source_->camera_state().stamp_source, StampSource::kArrival);
}

TEST_F(V4l2SourceFaults, LoseTheSourceWithEitherDeviceAndSayWhy) {
  for (FakeV4l2Device* camera : {&left_, &right_}) {
    start();
    camera->errors[VIDIOC_DQBUF] = EIO;
    EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
    EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
    EXPECT_THAT(source_->remarks(), Contains(HasSubstr("VIDIOC_DQBUF")));
    source_->stop();
    camera->errors.clear();
  }
}

TEST_F(V4l2SourceFaults, ReopenAfterALossAndCountOn) {
  start();
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(next_sequence(), 1);
  right_.is_gone = true;
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  source_->stop();
  const auto refused = source_->start();
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("/dev/video1"));
  EXPECT_EQ(system_.open_count(), 0);
  system_.pass(std::chrono::seconds(5));
  right_.is_gone = false;
  ASSERT_TRUE(source_->start());
  EXPECT_NEAR(static_cast<double>(next_sequence()), 102.0, 3.0);  // 5 s at 20 a second
  EXPECT_EQ(source_->stats().delivered, 1);
}

TEST_F(V4l2SourceFaults, LoseADeviceWhoseFormatChanges) {
  start();
  EXPECT_EQ(next_sequence(), 0);
  left_.events = {V4L2_EVENT_SOURCE_CHANGE};
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  source_->stop();
  left_.formats[0].width = 48;
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_THAT(started.error().message, HasSubstr("calibration's 32x16"));
}

TEST_F(V4l2SourceFaults, KeepLeasedPixelsOfALostDeviceUntilTheStop) {
  start();
  {
    const WaitResult held = next();
    ASSERT_EQ(held.status, WaitStatus::kFrame);
    left_.is_gone = true;
    EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
    EXPECT_EQ(held.lease.frame().left.at(2, 0), FakeV4l2Device::level(0, 2));
  }
  source_->stop();
}

TEST_F(V4l2SourceFaults, ReleaseTheFirstDeviceWhenTheSecondFails) {
  for (const unsigned long request : {VIDIOC_S_FMT, VIDIOC_REQBUFS, VIDIOC_STREAMON}) {
    right_.errors = {{request, EBUSY}};
    EXPECT_THAT(start_refusal(), HasSubstr("/dev/video1: another program uses the camera"));
    EXPECT_EQ(system_.open_count(), 0);
    EXPECT_EQ(system_.map_count(), 0);
  }
  right_.errors.clear();
  right_.maps_allowed = 3;
  EXPECT_THAT(start_refusal(), HasSubstr("mmap"));
  EXPECT_EQ(system_.map_count(), 0);
  right_.maps_allowed = 100;
  right_.open_error = EACCES;
  EXPECT_THAT(start_refusal(), HasSubstr("group video"));
}

using V4l2SourceDeathTest = V4l2SourceFaults;

TEST_F(V4l2SourceDeathTest, RefusesToStopUnderALease) {
  start();
  const WaitResult held = next();
  ASSERT_EQ(held.status, WaitStatus::kFrame);
  EXPECT_DEATH(source_->stop(), "lease");
}

}  // namespace
}  // namespace darkling::test
