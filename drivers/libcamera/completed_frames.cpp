// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/completed_frames.h"

#include <algorithm>

namespace darkling {

void CompletedFrames::push(const CompletedFrame& frame) {
  {
    const std::lock_guard lock(bell_.mutex);
    if (!frames_.push_back(frame)) return;
  }
  bell_.rung.notify_one();
}

void CompletedFrames::disconnect() {
  {
    const std::lock_guard lock(bell_.mutex);
    is_disconnected_ = true;
  }
  bell_.rung.notify_one();
}

std::optional<CompletedFrame> CompletedFrames::pop() {
  const std::lock_guard lock(bell_.mutex);
  if (frames_.is_empty()) return std::nullopt;
  const CompletedFrame oldest = frames_[0];
  frames_.erase(0);
  return oldest;
}

bool CompletedFrames::is_disconnected() const {
  const std::lock_guard lock(bell_.mutex);
  return is_disconnected_;
}

void CompletedFrames::wait_for_any(Doorbell& bell, std::span<const CompletedFrames* const> wanted,
                                   Duration timeout) {
  std::unique_lock lock(bell.mutex);
  bell.rung.wait_for(lock, timeout, [&] {
    return std::any_of(wanted.begin(), wanted.end(), [](const CompletedFrames* frames) {
      return frames != nullptr && (!frames->frames_.is_empty() || frames->is_disconnected_);
    });
  });
}

}  // namespace darkling
