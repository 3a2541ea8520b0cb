// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_device.h"

#include <cerrno>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/fake_v4l2.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kPath = "/dev/video0";
constexpr ImageExtent kEye{32, 16};

class V4l2DeviceTest : public ::testing::Test {
 protected:
  ~V4l2DeviceTest() override {
    device_.reset();
    EXPECT_EQ(system_.open_count(), 0);
    EXPECT_EQ(system_.map_count(), 0);
    EXPECT_THAT(system_.violations(), IsEmpty());
  }

  void start() {
    device_.reset();
    auto device = V4l2Device::open(system_, kPath, config_, kEye);
    ASSERT_TRUE(device) << device.error().message;
    device_ = std::move(*device);
    ASSERT_TRUE(device_->stream_on());
  }
  std::string refusal() {
    auto device = V4l2Device::open(system_, kPath, config_, kEye);
    Result<void> on = device ? (*device)->stream_on() : tl::unexpected<Error>(device.error());
    EXPECT_FALSE(on.has_value());
    return on ? "" : on.error().message;
  }
  TakenFrame take_next() {
    system_.pass(milliseconds(50));
    return device_->take();
  }
  // Alters the next buffer only.
  void alter_once(const std::function<void(v4l2_buffer&)>& change) {
    camera_.alter = [this, change](v4l2_buffer& buffer) {
      change(buffer);
      camera_.alter = nullptr;
    };
  }

  FakeV4l2 system_;
  FakeV4l2Device& camera_ = system_.device(kPath);
  CameraConfig config_;
  std::unique_ptr<V4l2Device> device_;
};

TEST_F(V4l2DeviceTest, HandsOutFullBuffersOldestFirst) {
  start();
  EXPECT_EQ(device_->take().taken, Taken::kNothing);
  system_.pass(milliseconds(100));
  const TakenFrame first = device_->take();
  const TakenFrame second = device_->take();
  ASSERT_EQ(first.taken, Taken::kFrame);
  ASSERT_EQ(second.taken, Taken::kFrame);
  EXPECT_EQ(second.sequence, first.sequence + 1);
  EXPECT_EQ(second.stamp - first.stamp, milliseconds(50));
  EXPECT_EQ(device_->pixels(second.buffer)[5], FakeV4l2Device::level(second.sequence, 5));
  EXPECT_EQ(device_->take().taken, Taken::kNothing);
}

TEST_F(V4l2DeviceTest, LendsABufferUntilItIsGivenBack) {
  start();
  for (int i = 0; i < V4l2Device::kBufferCount; ++i) EXPECT_EQ(take_next().taken, Taken::kFrame);
  EXPECT_EQ(device_->queued_count(), 0);
  EXPECT_EQ(take_next().taken, Taken::kNothing);
  device_->give_back(2);
  EXPECT_EQ(device_->queued_count(), 1);
  const TakenFrame next = take_next();
  EXPECT_EQ(next.taken, Taken::kFrame);
  EXPECT_EQ(next.buffer, 2);
  EXPECT_EQ(next.sequence, 5u);  // one had no buffer
}

TEST_F(V4l2DeviceTest, StopsThenUnmapsThenCloses) {
  start();
  device_.reset();
  EXPECT_THAT(camera_.history, ElementsAre("map", "map", "map", "map", "streamon", "streamoff",
                                           "unmap", "unmap", "unmap", "unmap", "close"));
}

TEST_F(V4l2DeviceTest, GivesABadBufferBackAndGoesOn) {
  start();
  alter_once([](v4l2_buffer& buffer) { buffer.flags |= V4L2_BUF_FLAG_ERROR; });
  EXPECT_EQ(take_next().taken, Taken::kBadBuffer);
  EXPECT_EQ(device_->queued_count(), V4l2Device::kBufferCount);
  EXPECT_EQ(take_next().taken, Taken::kFrame);
}

TEST_F(V4l2DeviceTest, TakesAShortBufferForABadOne) {
  start();
  alter_once([](v4l2_buffer& buffer) { --buffer.bytesused; });
  EXPECT_EQ(take_next().taken, Taken::kBadBuffer);
  EXPECT_EQ(take_next().taken, Taken::kFrame);
}

TEST_F(V4l2DeviceTest, IsLostOnEveryErrorOfTheStream) {
  for (const int error : {EIO, ENODEV, EINVAL, EPIPE}) {
    start();
    camera_.errors[VIDIOC_DQBUF] = error;
    EXPECT_EQ(take_next().taken, Taken::kLost);
    EXPECT_TRUE(device_->is_lost());
    EXPECT_THAT(device_->loss(), HasSubstr("VIDIOC_DQBUF"));
    EXPECT_EQ(device_->take().taken, Taken::kLost);
    camera_.errors.clear();
  }
}

TEST_F(V4l2DeviceTest, IsLostWhenABufferCannotBeQueuedAgain) {
  start();
  const TakenFrame frame = take_next();
  camera_.errors[VIDIOC_QBUF] = EINVAL;
  device_->give_back(frame.buffer);
  EXPECT_TRUE(device_->is_lost());
}

TEST_F(V4l2DeviceTest, IsLostWhenItGivesABufferThatItDoesNotHave) {
  start();
  alter_once([](v4l2_buffer& buffer) { buffer.index = 77; });
  EXPECT_EQ(take_next().taken, Taken::kLost);
  start();
  const int held = take_next().buffer;
  alter_once([held](v4l2_buffer& buffer) { buffer.index = held; });
  EXPECT_EQ(take_next().taken, Taken::kLost);
}

TEST_F(V4l2DeviceTest, IsLostOnPollErrorsAndChangesOfFormat) {
  for (const int events : {POLLERR, POLLHUP, POLLNVAL}) {
    start();
    device_->note_events(static_cast<short>(events));
    EXPECT_TRUE(device_->is_lost());
  }
  start();
  camera_.events = {V4L2_EVENT_SOURCE_CHANGE};
  device_->note_events(POLLPRI);
  EXPECT_THAT(device_->loss(), HasSubstr("format changed"));
}

TEST_F(V4l2DeviceTest, BearsOtherEvents) {
  start();
  camera_.events = {V4L2_EVENT_CTRL};
  device_->note_events(POLLPRI | POLLIN);
  device_->note_events(POLLPRI);  // and one that is none
  EXPECT_FALSE(device_->is_lost());
}

TEST_F(V4l2DeviceTest, IsLostWhenABufferIsShortBecauseTheFormatIsAnother) {
  start();
  alter_once([](v4l2_buffer& buffer) { buffer.bytesused = 100; });
  camera_.refuse = [](unsigned long request) { return request == VIDIOC_G_FMT ? EINVAL : 0; };
  EXPECT_EQ(take_next().taken, Taken::kLost);
}

TEST_F(V4l2DeviceTest, ReadsAnAutomaticExposureOnceASecond) {
  camera_.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 80;
  start();
  EXPECT_EQ(device_->state().exposure_ms, 8.0);
  camera_.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 40;
  system_.pass(milliseconds(999));
  device_->refresh_exposure();
  EXPECT_EQ(device_->state().exposure_ms, 8.0);
  system_.pass(milliseconds(1));
  device_->refresh_exposure();
  EXPECT_EQ(device_->state().exposure_ms, 4.0);
}

TEST_F(V4l2DeviceTest, SaysWhenAnotherProgramUsesTheCamera) {
  for (const unsigned long request : {VIDIOC_S_FMT, VIDIOC_REQBUFS, VIDIOC_QBUF, VIDIOC_STREAMON}) {
    camera_.errors = {{request, EBUSY}};
    EXPECT_THAT(refusal(), HasSubstr("another program uses the camera"));
    EXPECT_EQ(system_.open_count(), 0);
  }
}

TEST_F(V4l2DeviceTest, RefusesBuffersThatAreTooFewTooSmallOrNotMapped) {
  camera_.most_buffers = 1;
  EXPECT_THAT(refusal(), HasSubstr("gives 1 buffers"));
  camera_.most_buffers = 4;
  camera_.buffer_bytes = 100;
  EXPECT_THAT(refusal(), HasSubstr("100 bytes are too small"));
  camera_.buffer_bytes = 0;
  camera_.maps_allowed = 2;
  EXPECT_THAT(refusal(), HasSubstr("mmap"));
  EXPECT_EQ(system_.map_count(), 0);
}

TEST_F(V4l2DeviceTest, WorksWithTwoBuffers) {
  camera_.most_buffers = 2;
  start();
  for (int i = 0; i < 5; ++i) {
    const TakenFrame frame = take_next();
    ASSERT_EQ(frame.taken, Taken::kFrame);
    device_->give_back(frame.buffer);
  }
}

}  // namespace
}  // namespace darkling::test
