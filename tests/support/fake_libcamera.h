// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drivers/libcamera/request_camera.h"

namespace darkling::test {

// A camera that exposes when the test says so. Its frame k holds the byte k everywhere.
struct FakeCamera {
  // How it will be set up.
  ImageFormat format = {.format = PixelFormat::kGrey,
                        .fourcc = 0,
                        .extent = {.width = 32, .height = 16},
                        .stride_bytes = 32,
                        .bytes = 512};
  Duration period = std::chrono::milliseconds(50);
  int start_error = 0;
  int queue_error = 0;

  // What has become of it.
  bool is_open = false;
  bool is_started = false;
  int open_count = 0;
  std::deque<int> queued;
  std::uint32_t next_sequence = 0;
  std::vector<std::vector<std::uint8_t>> buffers;
  CompletedFrames* completed = nullptr;

  // Completes the oldest queued request as `frame` says, whose buffer and sequence are filled in.
  // Without a queued one the frame is lost. @return whether it was not.
  bool expose(CompletedFrame frame);
  void disconnect() { completed->disconnect(); }
};

// libcamera with the cameras that a test puts there.
class FakeLibcamera final : public LibcameraCalls {
 public:
  static constexpr int kBufferCount = 4;

  FakeCamera& camera(const std::string& id) { return cameras_[id]; }
  void remove(const std::string& id) { cameras_.erase(id); }
  [[nodiscard]] bool is_running() const { return is_running_; }
  [[nodiscard]] int open_count() const;

  Result<std::vector<std::string>> camera_ids() override;
  Result<std::unique_ptr<RequestCamera>> open(const std::string& id, const CameraConfig& config,
                                              ImageExtent eye, CompletedFrames& completed) override;
  void shut_down() override;
  [[nodiscard]] MonotonicTime now() const override { return read_monotonic_clock() + advance_; }
  // Time goes faster than it does.
  void advance(Duration by) { advance_ += by; }

 private:
  Duration advance_ = Duration::zero();
  std::map<std::string, FakeCamera> cameras_;
  bool is_running_ = false;
};

}  // namespace darkling::test
