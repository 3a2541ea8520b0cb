// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_source.h"

#include <condition_variable>
#include <mutex>
#include <thread>

#include "support/two_cameras.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

class V4l2SourceTest : public TwoCameras {};

std::uint8_t level(std::uint32_t sequence, std::size_t byte) {
  return FakeV4l2Device::level(sequence, byte);
}

TEST_F(V4l2SourceTest, PairsTwoDevices) {
  start();
  for (std::uint32_t k = 0; k < 10; ++k) {
    const WaitResult result = next();
    ASSERT_EQ(result.status, WaitStatus::kFrame);
    const StereoFrame& frame = result.lease.frame();
    EXPECT_EQ(frame.sequence, k);
    EXPECT_TRUE(frame.left.has_size(32, 16));
    EXPECT_TRUE(frame.right.has_size(32, 16));
    EXPECT_EQ(frame.left.at(3, 2), level(k, 67));
    EXPECT_EQ(frame.right.at(3, 2), level(k, 67));
  }
  EXPECT_EQ(source_->stats().delivered, 10);
  EXPECT_EQ(source_->stats().stamps_not_increasing, 0);
}

TEST_F(V4l2SourceTest, StampsTheMiddleOfTheLeftExposure) {
  left_.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 40;
  right_.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 40;
  start();
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  // Ready at 1000 s, begun 4 ms before.
  EXPECT_EQ(result.lease.frame().stamp.time_since_epoch(), milliseconds(999'998));
  const CameraState camera = source_->camera_state();
  EXPECT_EQ(camera.exposure_ms, 4.0);
  EXPECT_EQ(camera.rate_hz, 20.0);
  EXPECT_EQ(camera.stamp_source, StampSource::kStartOfExposure);
  EXPECT_EQ(camera.last_skew, milliseconds(2));
}

TEST_F(V4l2SourceTest, ShowsGreyWhereTheDevicePutItAndReadsPaddedRows) {
  left_.formats = {{V4L2_PIX_FMT_GREY, 32, 16, 48, 48 * 16}};
  start();
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  EXPECT_EQ(result.lease.frame().left.stride, 48);
  EXPECT_EQ(result.lease.frame().left.at(1, 1), level(0, 49));
}

TEST_F(V4l2SourceTest, ConvertsOtherFormatsAndKeepsTheDeviceItsBuffers) {
  left_.formats = {{V4L2_PIX_FMT_YUYV, 32, 16, 64, 64 * 16}};
  right_.formats = {{V4L2_PIX_FMT_UYVY, 32, 16, 64, 64 * 16}};
  start();
  std::vector<WaitResult> held;
  for (std::uint32_t k = 0; k < V4l2Source::kSlotCount; ++k) {
    held.push_back(next());
    ASSERT_EQ(held.back().status, WaitStatus::kFrame);
    const StereoFrame& frame = held.back().lease.frame();
    EXPECT_EQ(frame.left.at(5, 1), level(k, 74));
    EXPECT_EQ(frame.right.at(5, 1), level(k, 75));
  }
  EXPECT_EQ(held[0].lease.frame().left.at(5, 1), level(0, 74));
}

TEST_F(V4l2SourceTest, SwapsTheEyesOfTwoDevices) {
  config_.swap_eyes = true;
  left_.formats[0].stride_bytes = 40;
  left_.formats[0].image_bytes = 40 * 16;
  start();
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  EXPECT_EQ(result.lease.frame().right.stride, 40);
  EXPECT_EQ(source_->camera_state().last_skew, milliseconds(-2));
}

TEST_F(V4l2SourceTest, SplitsSharedImagesBothWaysAndSwapsThem) {
  config_.source = "v4l2:/dev/video0";
  left_.formats = {{V4L2_PIX_FMT_GREY, 64, 16, 64, 1024}, {V4L2_PIX_FMT_GREY, 32, 32, 32, 1024}};
  const auto corners = [&](EyeLayout layout, bool swap) {
    config_.layout = layout;
    config_.swap_eyes = swap;
    start();
    const WaitResult result = next();
    EXPECT_EQ(result.status, WaitStatus::kFrame);
    const StereoFrame& frame = result.lease.frame();
    EXPECT_TRUE(frame.left.has_size(32, 16) && frame.right.has_size(32, 16));
    return std::array{frame.left.at(0, 1), frame.right.at(0, 1)};
  };
  using enum EyeLayout;
  EXPECT_EQ(corners(kSideBySide, false), (std::array{level(0, 64), level(0, 96)}));
  EXPECT_EQ(corners(kSideBySide, true), (std::array{level(0, 96), level(0, 64)}));
  EXPECT_EQ(corners(kTopBottom, false), (std::array{level(0, 32), level(0, 32 * 17)}));
}

TEST_F(V4l2SourceTest, HalvesBayerImages) {
  for (FakeV4l2Device* camera : {&left_, &right_}) {
    camera->formats = {{V4L2_PIX_FMT_SRGGB8, 64, 32, 64, 2048}};
  }
  start();
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  EXPECT_TRUE(result.lease.frame().left.has_size(32, 16));
  EXPECT_EQ(result.lease.frame().left.at(0, 0), (0 + 1 + 64 + 65 + 2) / 4);
}

TEST_F(V4l2SourceTest, TimesOutInTimeWhenTheCamerasStall) {
  start();
  left_.is_stalled = true;
  right_.is_stalled = true;
  const MonotonicTime before = system_.now();
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
  const Duration waited = system_.now() - before;
  EXPECT_GE(waited, milliseconds(200));
  EXPECT_LT(waited, milliseconds(201));
}

TEST_F(V4l2SourceTest, TimesOutInTimeWhileAllBuffersAreOnLoanAndGoesOnAfterwards) {
  start();
  std::vector<WaitResult> held;
  for (int k = 0; k < V4l2Device::kBufferCount; ++k) held.push_back(next());
  ASSERT_EQ(held.back().status, WaitStatus::kFrame);
  const std::uint8_t before = held[0].lease.frame().left.at(1, 1);
  const MonotonicTime since = system_.now();
  EXPECT_EQ(next().status, WaitStatus::kTimeout);
  EXPECT_LT(system_.now() - since, milliseconds(201));
  EXPECT_EQ(held[0].lease.frame().left.at(1, 1), before);
  held.clear();
  EXPECT_GT(next_sequence(), V4l2Device::kBufferCount);  // the gap says what had no buffer
  EXPECT_GT(source_->stats().dropped_by_device, 0);
}

TEST_F(V4l2SourceTest, GivesALeaseBackToTheDeviceWhileItWaits) {
  start();
  std::vector<WaitResult> held;
  for (int k = 0; k < V4l2Device::kBufferCount; ++k) held.push_back(next());
  int polls = 0;
  system_.on_poll = [&] {
    if (++polls == 3) held.clear();
  };
  EXPECT_EQ(next().status, WaitStatus::kFrame);
}

// One thread captures, another looks at each frame for a while and gives it back.
TEST_F(V4l2SourceTest, TakesLeasesBackFromAnotherThread) {
  constexpr int kPairs = 500;
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
      const ImageView<const std::uint8_t>& left = lease.frame().left;
      const auto step = static_cast<std::uint8_t>(left.at(31, 15) - left.at(0, 0));
      wrong += step == static_cast<std::uint8_t>(511) ? 0 : 1;
    }
  });
  for (int delivered = 0; delivered < kPairs;) {
    WaitResult result = next();
    if (result.status != WaitStatus::kFrame) {
      std::this_thread::yield();
      continue;
    }
    ++delivered;
    const std::lock_guard lock(mutex);
    queue.push_back(std::move(result.lease));
    changed.notify_one();
  }
  reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(source_->stats().delivered, kPairs);
}

// 20 Hz and a phase of 26 ms: the frame before its own is 24 ms away, within the tolerance.
TEST_F(V4l2SourceTest, NeverPairsAcrossHalfAPeriod) {
  config_.max_skew_ms = 100.0;
  right_.phase = milliseconds(26);
  start();
  for (int k = 0; k < 20; ++k) {
    const WaitResult result = next();
    if (result.status != WaitStatus::kFrame) continue;
    EXPECT_LE(std::chrono::abs(source_->camera_state().last_skew), milliseconds(25));
  }
  EXPECT_GT(source_->stats().delivered, 17);
}

TEST_F(V4l2SourceTest, SaysWhatIsNotAsAsked) {
  config_.rate_hz = 30.0;
  left_.shortest_period = milliseconds(50);
  right_.shortest_period = milliseconds(50);
  start();
  EXPECT_THAT(source_->remarks(), Contains(HasSubstr("/dev/video1: gives 20 frames a second")));
  EXPECT_EQ(source_->camera_state().rate_hz, 20.0);
}

TEST(V4l2SourceCreate, RefusesSettingsThatDoNotGoTogether) {
  const auto refuse = [](CameraConfig config, ImageExtent eye, ExitCode code) {
    FakeV4l2 system;
    const auto source = V4l2Source::create(config, eye, system);
    ASSERT_FALSE(source.has_value());
    EXPECT_EQ(source.error().code, code) << source.error().message;
  };
  CameraConfig two;
  two.source = "v4l2:/dev/video0,/dev/video1";
  CameraConfig one = two;
  one.source = "v4l2:/dev/video0";
  const ImageExtent eye{32, 16};
  refuse(one, eye, ExitCode::kConfiguration);
  two.layout = EyeLayout::kTopBottom;
  refuse(two, eye, ExitCode::kConfiguration);
  two.layout = EyeLayout::kTwoDevices;
  refuse(two, {0, 16}, ExitCode::kConfiguration);
  two.rate_hz = 0.0;
  refuse(two, eye, ExitCode::kConfiguration);
  two.rate_hz = 20.0;
  two.gain = -1.0;
  refuse(two, eye, ExitCode::kConfiguration);
  two.source = "v4l2:video0";
  refuse(two, eye, ExitCode::kUsage);
}

}  // namespace
}  // namespace darkling::test
