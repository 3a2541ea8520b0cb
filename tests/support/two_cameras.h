// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/v4l2/v4l2_source.h"
#include "support/fake_v4l2.h"

namespace darkling::test {

// Two grey cameras of 32x16 pixels, the right one 2 ms behind the left; 20 pairs a second. Whatever
// a test does to them, in the end nothing is open or mapped.
class TwoCameras : public ::testing::Test {
 protected:
  TwoCameras() {
    config_.source = "v4l2:/dev/video0,/dev/video1";
    right_.phase = std::chrono::milliseconds(2);
  }
  ~TwoCameras() override {
    source_.reset();
    EXPECT_EQ(system_.open_count(), 0);
    EXPECT_EQ(system_.map_count(), 0);
    EXPECT_THAT(system_.violations(), ::testing::IsEmpty());
  }

  void create() {
    source_.reset();
    auto source = V4l2Source::create(config_, {.width = 32, .height = 16}, system_);
    ASSERT_TRUE(source) << source.error().message;
    source_ = std::move(*source);
  }
  void start() {
    create();
    const auto started = source_->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  std::string start_refusal() {
    create();
    const auto started = source_->start();
    EXPECT_FALSE(started.has_value());
    if (started) return "";
    EXPECT_EQ(started.error().code, ExitCode::kDeviceUnavailable);
    return started.error().message;
  }
  WaitResult next() { return source_->wait_next(std::chrono::milliseconds(200)); }
  // The number of the next pair; -1 when something else comes.
  std::int64_t next_sequence() {
    const WaitResult result = next();
    return result.status == WaitStatus::kFrame ? result.lease.frame().sequence : -1;
  }

  FakeV4l2 system_;
  FakeV4l2Device& left_ = system_.device("/dev/video0");
  FakeV4l2Device& right_ = system_.device("/dev/video1");
  CameraConfig config_;
  std::unique_ptr<V4l2Source> source_;
};

}  // namespace darkling::test
