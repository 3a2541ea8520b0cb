// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "drivers/frame_source.h"

namespace darkling {

// Another source, recorded or rendered, as if it were a camera: frames come when as much time has
// passed since the first as when they were taken, and are stamped by CLOCK_MONOTONIC with the time
// they came. A frame that is taken too late comes at once.
class PacedSource final : public FrameSource {
 public:
  explicit PacedSource(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] SourceStats stats() const override { return source_->stats(); }
  [[nodiscard]] CameraState camera_state() const override;

 private:
  std::unique_ptr<FrameSource> source_;
  std::optional<WaitResult> pending_;  // taken from the source, not due yet
  bool has_started_ = false;
  FrameTime first_stamp_;
  MonotonicTime first_at_;
};

}  // namespace darkling
