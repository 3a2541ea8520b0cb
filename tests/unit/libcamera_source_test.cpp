// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/libcamera_source.h"

#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/clocks.h"
#include "support/fake_libcamera.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr ImageExtent kEye = {.width = 32, .height = 16};
constexpr Duration kShort = milliseconds(20);

// Two grey cameras of 32x16 pixels. Whatever a test does to them, in the end nothing is open.
class LibcameraSource : public ::testing::Test {
 protected:
  LibcameraSource() { config_.source = "libcamera:/soc/cam@10,/soc/cam@20"; }
  ~LibcameraSource() override {
    source_.reset();
    EXPECT_EQ(library_.open_count(), 0);
    EXPECT_FALSE(library_.is_running());
  }

  void share() {
    config_.source = "libcamera:cam@10";
    config_.layout = EyeLayout::kSideBySide;
    left_.format.extent.width = 64;
    left_.format.stride_bytes = 64;
    left_.format.bytes = 1024;
  }
  void create() {
    auto source = create_libcamera_source(config_, kEye, library_);
    ASSERT_TRUE(source) << source.error().message;
    source_ = std::move(*source);
  }
  void start() {
    if (source_ == nullptr) create();
    const auto started = source_->start();
    ASSERT_TRUE(started) << started.error().message;
    begun_ = read_monotonic_clock() - std::chrono::seconds(100);
  }
  // What the cameras say of pair k, 50 ms after the one before.
  [[nodiscard]] CompletedFrame frame(int k, Duration phase = Duration::zero()) const {
    CompletedFrame frame;
    frame.is_whole = true;
    frame.stamp_ns = to_ns(begun_ + k * milliseconds(50) + phase);
    frame.is_of_sensor = true;
    frame.exposure_ms = 4.0;
    frame.gain = 2.0;
    frame.arrival = begun_ + k * milliseconds(50) + milliseconds(30);
    return frame;
  }
  void expose(int k) {
    left_.expose(frame(k));
    right_.expose(frame(k, milliseconds(2)));
  }
  WaitResult next() { return source_->wait_next(kShort); }
  std::int64_t next_sequence() {
    const WaitResult result = next();
    return result.status == WaitStatus::kFrame ? result.lease.frame().sequence : -1;
  }

  FakeLibcamera library_;
  FakeCamera& left_ = library_.camera("/soc/cam@10");
  FakeCamera& right_ = library_.camera("/soc/cam@20");
  CameraConfig config_;
  std::unique_ptr<FrameSource> source_;
  MonotonicTime begun_;
};

TEST_F(LibcameraSource, PairsTwoCamerasByTheMiddleOfTheirExposures) {
  start();
  for (int k = 0; k < 10; ++k) {
    expose(k);
    const WaitResult result = next();
    ASSERT_EQ(result.status, WaitStatus::kFrame);
    const StereoFrame& pair = result.lease.frame();
    EXPECT_EQ(pair.sequence, k);
    EXPECT_EQ(to_ns(pair.stamp), frame(k).stamp_ns + 2'000'000);
    EXPECT_EQ(pair.left.at(31, 15), k);
    EXPECT_EQ(pair.right.at(31, 15), k);
  }
  const CameraState camera = source_->camera_state();
  EXPECT_EQ(camera.exposure_ms, 4.0);
  EXPECT_EQ(camera.gain, 2.0);
  EXPECT_EQ(camera.rate_hz, 20.0);
  EXPECT_EQ(camera.stamp_source, StampSource::kStartOfExposure);
  EXPECT_EQ(camera.stamp_uncertainty, milliseconds(4));
  EXPECT_EQ(camera.last_skew, milliseconds(2));
}

TEST_F(LibcameraSource, SplitsTheImageOfOneCamera) {
  share();
  start();
  left_.expose(frame(0));
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  const StereoFrame& pair = result.lease.frame();
  EXPECT_TRUE(pair.left.has_size(32, 16) && pair.right.has_size(32, 16));
  EXPECT_EQ(pair.right.data, pair.left.data + 32);
}

TEST_F(LibcameraSource, ConvertsColoursAndKeepsTheCameraItsBuffers) {
  for (FakeCamera* camera : {&left_, &right_}) {
    camera->format.format = PixelFormat::kBgr;
    camera->format.stride_bytes = 96;
    camera->format.bytes = 96 * 16;
  }
  start();
  expose(0);
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  EXPECT_EQ(result.lease.frame().left.stride, 32);
  EXPECT_EQ(left_.queued.size(), 4u);
}

TEST_F(LibcameraSource, ReportsABadRequestInItsPlaceAndQueuesItAgain) {
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

TEST_F(LibcameraSource, ReportsTheOtherEyeOfABadRequestAsUnpaired) {
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

TEST_F(LibcameraSource, TimesOutWhileAllBuffersAreOnLoanAndLeavesAGapForWhatWasLost) {
  share();
  start();
  std::vector<WaitResult> held;
  for (int k = 0; k < FakeLibcamera::kBufferCount; ++k) {
    left_.expose(frame(k));
    held.push_back(next());
    ASSERT_EQ(held.back().status, WaitStatus::kFrame);
  }
  EXPECT_FALSE(left_.expose(frame(4)));
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
  EXPECT_EQ(held[0].lease.frame().left.at(0, 0), 0);
  held.clear();
  EXPECT_EQ(next().status, WaitStatus::kTimeout);  // queues them again
  EXPECT_EQ(left_.queued.size(), 4u);
  left_.expose(frame(5));
  EXPECT_EQ(next_sequence(), 5);
  EXPECT_EQ(source_->stats().dropped_by_device, 1);
}

TEST_F(LibcameraSource, WakesForAFrameThatAnotherThreadBrings) {
  share();
  start();
  std::thread library([&] {
    std::this_thread::sleep_for(milliseconds(10));
    left_.expose(frame(0));
  });
  EXPECT_EQ(source_->wait_next(std::chrono::seconds(20)).status, WaitStatus::kFrame);
  library.join();
}

TEST_F(LibcameraSource, TakesLeasesBackFromAnotherThread) {
  constexpr int kPairs = 300;
  start();
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<FrameLease> queue;
  int wrong = 0;
  std::thread reader([&] {
    for (int seen = 0; seen < kPairs; ++seen) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return !queue.empty(); });
      const FrameLease lease = std::move(queue.front());
      queue.erase(queue.begin());
      lock.unlock();
      const StereoFrame& pair = lease.frame();
      wrong += pair.left.at(31, 15) == static_cast<std::uint8_t>(pair.sequence) ? 0 : 1;
    }
  });
  int k = 0;
  for (int delivered = 0; delivered < kPairs;) {
    if (!left_.queued.empty() && !right_.queued.empty()) expose(k++);
    WaitResult result = source_->wait_next(milliseconds(1));
    if (result.status != WaitStatus::kFrame) continue;
    ++delivered;
    const std::lock_guard lock(mutex);
    queue.push_back(std::move(result.lease));
    changed.notify_one();
  }
  reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(source_->stats().delivered, kPairs);
}

TEST_F(LibcameraSource, DeliversWhatCameBeforeACameraWentAndOpensItAnew) {
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

TEST_F(LibcameraSource, IsLostWhenARequestIsRefused) {
  start();
  expose(0);
  left_.queue_error = -ENODEV;
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(next().status, WaitStatus::kDeviceLost);
  EXPECT_THAT(source_->remarks(), Contains(HasSubstr("queueing a request: No such device")));
}

TEST_F(LibcameraSource, TakesACameraThatIsSilentForLost) {
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

TEST_F(LibcameraSource, IsNotLostForSilenceWhileItHasNoBuffers) {
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

TEST_F(LibcameraSource, ClosesWhatItHasOpenedWhenTheOtherCannotStart) {
  create();
  right_.start_error = -EIO;
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_EQ(started.error().code, ExitCode::kDeviceUnavailable);
  EXPECT_THAT(started.error().message, HasSubstr("/soc/cam@20"));
  EXPECT_EQ(library_.open_count(), 0);
  EXPECT_FALSE(library_.is_running());
}

TEST_F(LibcameraSource, NamesTheCamerasThereAreWhenTheOneItWantsIsNot) {
  create();
  library_.remove("/soc/cam@10");
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_EQ(started.error().code, ExitCode::kDeviceUnavailable);
  EXPECT_THAT(started.error().message,
              HasSubstr("there is none; libcamera sees 0 \"/soc/cam@20\""));
}

TEST_F(LibcameraSource, RefusesOneCameraForBothEyes) {
  config_.source = "libcamera:0,cam@10";
  create();
  const auto started = source_->start();
  ASSERT_FALSE(started.has_value());
  EXPECT_THAT(started.error().message, HasSubstr("both eyes are this camera"));
}

}  // namespace
}  // namespace darkling::test
