// SPDX-License-Identifier: Apache-2.0
// Devices that answer anything: the driver survives, and leaves nothing open or mapped.
#include <cerrno>
#include <deque>

#include "support/random.h"
#include "support/two_cameras.h"

namespace darkling::test {
namespace {

class HostileCameras : public TwoCameras {
 protected:
  void make_hostile(FakeV4l2Device& camera, int per_mille) {
    camera.refuse = [=, this](unsigned long request) {
      // What never fails in any kernel, and would only end the run.
      if (request == VIDIOC_STREAMOFF || random_.integer(0, 999) >= per_mille) return 0;
      constexpr std::array kErrors = {EAGAIN, EBUSY, EINVAL, EIO, ENODEV, ENOMEM, ENOTTY, EPIPE};
      return kErrors[random_.integer(0, static_cast<int>(kErrors.size()) - 1)];
    };
    camera.alter = [=, this](v4l2_buffer& buffer) {
      if (random_.integer(0, 999) >= 20 * per_mille) return;
      switch (random_.integer(0, 5)) {
        case 0:
          buffer.flags = any();
          break;
        case 1:
          buffer.bytesused = any();
          break;
        case 2:
          buffer.sequence = any();
          break;
        case 3:
          buffer.timestamp.tv_sec = static_cast<time_t>(any()) * random_.integer(-1, 1);
          break;
        case 4:
          buffer.timestamp.tv_usec = static_cast<suseconds_t>(any());
          break;
        default:
          if (random_.integer(0, 9) == 0) buffer.index = any() % 6;
      }
    };
  }

  std::uint32_t any() { return static_cast<std::uint32_t>(random_.integer(0, 0x7FFFFFFF)) * 3U; }

  // One call of the source, and what the rest of the service would do about its answer.
  void step() {
    if (!is_running_) {
      is_running_ = source_->start().has_value();
      return;
    }
    for (FakeV4l2Device* camera : {&left_, &right_}) {
      camera->is_stalled = random_.integer(0, 99) < 3;
      if (random_.integer(0, 499) == 0) camera->events.push_back(any() % 8);
    }
    WaitResult result = source_->wait_next(std::chrono::milliseconds(random_.integer(0, 120)));
    ++seen_[result.status];
    if (result.status == WaitStatus::kFrame) take(std::move(result.lease));
    if (result.status == WaitStatus::kBadFrame) check_grows(result.sequence);
    while (!held_.empty() && random_.integer(0, 2) != 0) held_.pop_front();
    if (result.status != WaitStatus::kDeviceLost) return;
    held_.clear();
    source_->stop();
    is_running_ = false;
    EXPECT_EQ(system_.open_count(), 0);
    EXPECT_EQ(system_.map_count(), 0);
  }

  void take(FrameLease lease) {
    const StereoFrame& frame = lease.frame();
    EXPECT_LE(to_ns(frame.stamp), to_ns(system_.now()));
    ASSERT_TRUE(frame.left.has_size(32, 16) && frame.right.has_size(32, 16));
    sum_ += frame.left.at(31, 15) + frame.right.at(31, 15);  // a sanitizer sees what is not there
    check_grows(frame.sequence);
    held_.push_back(std::move(lease));
  }
  void check_grows(std::int64_t sequence) {
    EXPECT_GT(sequence, last_sequence_);
    last_sequence_ = sequence;
  }

  void run(int steps) {
    create();
    for (int i = 0; i < steps; ++i) step();
    held_.clear();
    EXPECT_GT(seen_[WaitStatus::kFrame], steps / 20);
    EXPECT_GT(seen_[WaitStatus::kBadFrame], 0);
    EXPECT_GT(seen_[WaitStatus::kTimeout], 0);
    EXPECT_GT(seen_[WaitStatus::kDeviceLost], steps / 200);
    EXPECT_EQ(seen_[WaitStatus::kUnknown] + seen_[WaitStatus::kEndOfSource], 0);
  }

  Random random_{20};
  std::deque<FrameLease> held_;
  std::map<WaitStatus, int> seen_;
  std::int64_t last_sequence_ = -1;
  int sum_ = 0;
  bool is_running_ = false;
};

TEST_F(HostileCameras, DoNotBreakTheSourceOfTwoGreyDevices) {
  make_hostile(left_, 5);
  make_hostile(right_, 5);
  run(10'000);
}

TEST_F(HostileCameras, DoNotBreakTheSourceOfConvertedImages) {
  left_.formats = {{V4L2_PIX_FMT_Y10P, 32, 16, 40, 640}};
  right_.formats = {{V4L2_PIX_FMT_SGBRG8, 64, 32, 64, 2048}};
  make_hostile(left_, 5);
  make_hostile(right_, 5);
  run(10'000);
}

TEST_F(HostileCameras, DoNotBreakTheSourceOfASharedImage) {
  config_.source = "v4l2:/dev/video0";
  config_.layout = EyeLayout::kTopBottom;
  left_.formats = {{V4L2_PIX_FMT_GREY, 32, 32, 32, 1024}};
  left_.most_buffers = 3;
  make_hostile(left_, 10);
  run(10'000);
}

}  // namespace
}  // namespace darkling::test
