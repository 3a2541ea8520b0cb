// SPDX-License-Identifier: Apache-2.0
#include <cerrno>

#include "support/two_libcamera_cameras.h"

namespace darkling::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class LibcameraSourceFaults : public TwoLibcameraCameras {};

TEST_F(LibcameraSourceFaults, ReportsABadRequestInItsPlaceAndQueuesItAgain) {
  share();
  start();
  for (int k = 0; k < 3; ++k) {
    CompletedFrame completed = frame(k);
    completed.is_whole = k != 1;
    left_.expose(completed);
  }
  EXPECT_EQ(next_sequence(), 0);
  const WaitResult bad = next();
  EXPECT_EQ(bad.status, WaitStatus::kBadFrame);
  EXPECT_EQ(bad.fault, FrameFault::kUnreadable);
  EXPECT_EQ(bad.sequence, 1);
  EXPECT_EQ(next_sequence(), 2);
  EXPECT_EQ(source_->stats().device_errors, 1);
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
  EXPECT_EQ(left_.queued.size(), 4u);
}

TEST_F(LibcameraSourceFaults, ReportsTheOtherEyeOfABadRequestAsUnpaired) {
  start();
  for (int k = 0; k < 3; ++k) {
    CompletedFrame completed = frame(k);
    completed.is_whole = k != 1;
    left_.expose(completed);
    right_.expose(frame(k));
  }
  EXPECT_EQ(next_sequence(), 0);
  const WaitResult bad = next();
  EXPECT_EQ(bad.fault, FrameFault::kUnpaired);
  EXPECT_EQ(bad.sequence, 1);
  EXPECT_EQ(next_sequence(), 2);
  EXPECT_EQ(source_->stats().unpaired, 1);
}

TEST_F(LibcameraSourceFaults, CountsStampsOfTheFutureAndGoesOnAtTheSamePace) {
  share();
  start();
  FrameTime before;
  for (int k = 0; k < 4; ++k) {
    CompletedFrame completed = frame(k);
    if (k == 2) completed.stamp_ns += to_ns(MonotonicTime(std::chrono::hours(1)));
    left_.expose(completed);
    const WaitResult result = next();
    ASSERT_EQ(result.status, WaitStatus::kFrame);
    const FrameTime stamp = result.lease.frame().stamp;
    if (k > 0) {
      EXPECT_EQ(stamp - before, std::chrono::milliseconds(50));
    }
    before = stamp;
  }
  EXPECT_EQ(source_->stats().stamps_of_future, 1);
  EXPECT_EQ(source_->stats().device_errors, 0);
}

TEST_F(LibcameraSourceFaults, DeliversWhatCameBeforeACameraWentAndOpensItAnew) {
  start();
  expose(0);
  right_.disconnect();
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  EXPECT_THAT(source_->remarks(), Contains(HasSubstr("/soc/cam@20\": lost, it has gone")));
  source_->stop();
  EXPECT_FALSE(library_.is_running());
  start();
  expose(0);
  EXPECT_GT(next_sequence(), 1);  // a gap for the time between
  EXPECT_EQ(right_.open_count, 2);
}

TEST_F(LibcameraSourceFaults, IsLostWhenARequestIsRefused) {
  start();
  expose(0);
  left_.queue_error = -ENODEV;
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  EXPECT_THAT(source_->remarks(), Contains(HasSubstr("queueing a request: No such device")));
}

TEST_F(LibcameraSourceFaults, TakesACameraThatIsSilentForLost) {
  start();
  expose(0);
  EXPECT_EQ(next_sequence(), 0);
  library_.advance(std::chrono::seconds(2));
  expose(1);
  EXPECT_EQ(next_sequence(), 1);
  library_.advance(std::chrono::seconds(2));
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
  library_.advance(std::chrono::seconds(2));
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  EXPECT_THAT(source_->remarks(), Contains(HasSubstr("it brings no more frames")));
}

TEST_F(LibcameraSourceFaults, IsNotLostForSilenceWhileItHasNoBuffers) {
  share();
  start();
  std::vector<WaitResult> held;
  for (int k = 0; k < FakeLibcamera::kBufferCount; ++k) {
    left_.expose(frame(k));
    held.push_back(next());
  }
  library_.advance(std::chrono::seconds(20));
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
  held.clear();
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
}

TEST_F(LibcameraSourceFaults, ClosesWhatItHasOpenedWhenTheOtherCannotStart) {
  create();
  right_.start_error = -EIO;
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_EQ(started.error().code, ExitCode::kDeviceUnavailable);
  EXPECT_THAT(started.error().message, HasSubstr("/soc/cam@20"));
  EXPECT_EQ(library_.open_count(), 0);
  EXPECT_FALSE(library_.is_running());
}

TEST_F(LibcameraSourceFaults, NamesTheCamerasThereAreWhenTheOneItWantsIsNot) {
  create();
  library_.remove("/soc/cam@10");
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_EQ(started.error().code, ExitCode::kDeviceUnavailable);
  EXPECT_THAT(started.error().message,
              HasSubstr("there is none; libcamera sees 0 \"/soc/cam@20\""));
}

TEST_F(LibcameraSourceFaults, RefusesOneCameraForBothEyes) {
  config_.source = "libcamera:0,cam@10";
  create();
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_THAT(started.error().message, HasSubstr("both eyes are this camera"));
}

}  // namespace
}  // namespace darkling::test
