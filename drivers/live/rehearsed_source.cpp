// SPDX-License-Identifier: Apache-2.0
#include "drivers/live/rehearsed_source.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "platform/process_memory.h"

namespace darkling {

namespace {

ImageView<const std::uint8_t> copy(ImageView<const std::uint8_t> image,
                                   std::vector<std::uint8_t>& pixels) {
  pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y) {
    std::copy_n(image.row(y), image.width, pixels.data() + std::ptrdiff_t{y} * image.width);
  }
  return {pixels.data(), image.width, image.height, image.width};
}

}  // namespace

Result<void> RehearsedSource::start() {
  delivered_.store(0, std::memory_order_relaxed);
  return pairs_.empty() ? rehearse() : Result<void>();
}

Result<void> RehearsedSource::rehearse() {
  if (auto started = source_->start(); !started) return started;
  for (;;) {
    const WaitResult next = source_->wait_next(std::chrono::seconds(1));
    if (next.status == WaitStatus::kEndOfSource || next.status == WaitStatus::kDeviceLost) break;
    if (next.status != WaitStatus::kFrame) continue;
    Pair& pair = pairs_.emplace_back();
    pair.frame = next.lease.frame();
    pair.frame.left = copy(next.lease.frame().left, pair.left);
    pair.frame.right = copy(next.lease.frame().right, pair.right);
  }
  source_->stop();
  constexpr std::size_t kFewestPairs = 2;
  if (pairs_.size() >= kFewestPairs) {
    source_.reset();  // with all the memory that it has
    return_free_memory();
    return {};
  }
  const std::string found = std::to_string(std::exchange(pairs_, {}).size());
  return failure(ExitCode::kBadInput,
                 "a scene to be played for ever: found " + found + " frames, 2 are needed");
}

WaitResult RehearsedSource::wait_next(Duration) {
  const std::int64_t number = delivered_.load(std::memory_order_relaxed);
  if (frames_ > 0 && number >= frames_) return {.status = WaitStatus::kEndOfSource};
  // 0, 1, …, n-1, n-2, …, 1, 0, 1, …
  const auto period = 2 * (static_cast<std::int64_t>(pairs_.size()) - 1);
  const std::int64_t phase = number % period;
  StereoFrame frame = pairs_[static_cast<std::size_t>(std::min(phase, period - phase))].frame;
  frame.sequence = number;
  frame.stamp = frame_time_from_ns(std::llround(static_cast<double>(number) * 1e9 / rate_hz_));
  delivered_.store(number + 1, std::memory_order_relaxed);
  WaitResult result;
  result.status = WaitStatus::kFrame;
  // Nothing is given back: the pixels are never written again.
  result.lease = FrameLease(
      frame, [](void*, int) {}, nullptr, 0);
  return result;
}

}  // namespace darkling
