// SPDX-License-Identifier: Apache-2.0
#include "support/fake_libcamera.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace darkling::test {

namespace {

class FakeRequests final : public RequestCamera {
 public:
  FakeRequests(FakeCamera& camera, CompletedFrames& completed) : camera_(camera) {
    setup_.format = camera.format;
    setup_.buffer_count = FakeLibcamera::kBufferCount;
    setup_.period = camera.period;
    camera.is_open = true;
    ++camera.open_count;
    camera.completed = &completed;
    camera.next_sequence = 0;
    camera.buffers.assign(FakeLibcamera::kBufferCount,
                          std::vector<std::uint8_t>(camera.format.bytes));
  }
  ~FakeRequests() override {
    camera_.is_open = false;
    camera_.is_started = false;
    camera_.queued.clear();
    camera_.buffers.clear();
    camera_.completed = nullptr;
  }
  FakeRequests(const FakeRequests&) = delete;
  FakeRequests& operator=(const FakeRequests&) = delete;

  [[nodiscard]] const CameraSetup& setup() const override { return setup_; }
  int start() override {
    camera_.is_started = camera_.start_error == 0;
    return camera_.start_error;
  }
  int queue(int buffer) override {
    EXPECT_TRUE(camera_.is_started);
    EXPECT_EQ(std::count(camera_.queued.begin(), camera_.queued.end(), buffer), 0);
    if (camera_.queue_error == 0) camera_.queued.push_back(buffer);
    is_read_[buffer] = false;
    return camera_.queue_error;
  }
  void begin_reading(int buffer) override { is_read_[buffer] = true; }
  [[nodiscard]] const std::uint8_t* pixels(int buffer) const override {
    EXPECT_TRUE(is_read_[buffer]);
    return camera_.buffers[buffer].data();
  }

 private:
  FakeCamera& camera_;
  CameraSetup setup_;
  std::array<bool, FakeLibcamera::kBufferCount> is_read_ = {};
};

}  // namespace

bool FakeCamera::expose(CompletedFrame frame) {
  frame.sequence = next_sequence++;
  if (queued.empty()) return false;
  frame.buffer = queued.front();
  queued.pop_front();
  auto& pixels = buffers[frame.buffer];
  std::fill(pixels.begin(), pixels.end(), static_cast<std::uint8_t>(frame.sequence));
  completed->push(frame);
  return true;
}

int FakeLibcamera::open_count() const {
  return static_cast<int>(std::count_if(cameras_.begin(), cameras_.end(),
                                        [](const auto& entry) { return entry.second.is_open; }));
}

Result<std::vector<std::string>> FakeLibcamera::camera_ids() {
  is_running_ = true;
  std::vector<std::string> ids;
  for (const auto& [id, camera] : cameras_) ids.push_back(id);
  return ids;
}

Result<std::unique_ptr<RequestCamera>> FakeLibcamera::open(const std::string& id,
                                                           const CameraConfig& /*config*/,
                                                           ImageExtent /*eye*/,
                                                           CompletedFrames& completed) {
  EXPECT_TRUE(is_running_);
  FakeCamera& found = cameras_.at(id);
  if (found.is_open) return failure(ExitCode::kDeviceUnavailable, id + ": taken");
  return std::make_unique<FakeRequests>(found, completed);
}

void FakeLibcamera::shut_down() {
  EXPECT_EQ(open_count(), 0);
  is_running_ = false;
}

}  // namespace darkling::test
