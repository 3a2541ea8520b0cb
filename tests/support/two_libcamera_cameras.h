// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/libcamera/libcamera_source.h"
#include "platform/clocks.h"
#include "support/fake_libcamera.h"

namespace darkling::test {

// Two grey cameras of 32x16 pixels. Whatever a test does to them, in the end nothing is open.
class TwoLibcameraCameras : public ::testing::Test {
 protected:
  TwoLibcameraCameras() { config_.source = "libcamera:/soc/cam@10,/soc/cam@20"; }
  ~TwoLibcameraCameras() override {
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
    auto source = create_libcamera_source(config_, {.width = 32, .height = 16}, library_);
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
    frame.stamp_ns = to_ns(begun_ + k * std::chrono::milliseconds(50) + phase);
    frame.is_of_sensor = true;
    frame.exposure_ms = 4.0;
    frame.gain = 2.0;
    frame.arrival = begun_ + k * std::chrono::milliseconds(50) + std::chrono::milliseconds(30);
    return frame;
  }
  void expose(int k) {
    left_.expose(frame(k));
    right_.expose(frame(k, std::chrono::milliseconds(2)));
  }
  WaitResult next() { return source_->wait_next(std::chrono::milliseconds(20)); }
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

}  // namespace darkling::test
