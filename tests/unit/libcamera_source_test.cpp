// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/libcamera_source.h"

#include <condition_variable>
#include <mutex>
#include <thread>

#include "support/two_libcamera_cameras.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;

class LibcameraSource : public TwoLibcameraCameras {};

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

}  // namespace
}  // namespace darkling::test
