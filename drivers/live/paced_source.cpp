// SPDX-License-Identifier: Apache-2.0
#include "drivers/live/paced_source.h"

#include <utility>

#include "platform/clocks.h"

namespace darkling {

Result<void> PacedSource::start() {
  pending_.reset();
  has_started_ = false;
  return source_->start();
}

void PacedSource::stop() {
  pending_.reset();
  source_->stop();
}

CameraState PacedSource::camera_state() const {
  return {.stamp_source = StampSource::kArrival};
}

WaitResult PacedSource::wait_next(Duration timeout) {
  const MonotonicTime give_up_at = read_monotonic_clock() + timeout;
  if (!pending_) {
    WaitResult next = source_->wait_next(timeout);
    if (next.status != WaitStatus::kFrame && next.status != WaitStatus::kBadFrame) return next;
    pending_ = std::move(next);
  }
  const bool is_frame = pending_->status == WaitStatus::kFrame;
  const FrameTime taken_at = is_frame ? pending_->lease.frame().stamp : pending_->stamp;
  if (!has_started_) {
    has_started_ = true;
    first_stamp_ = taken_at;
    first_at_ = read_monotonic_clock();
  }
  const MonotonicTime due_at = first_at_ + (taken_at - first_stamp_);
  if (due_at > give_up_at) {
    static_cast<void>(sleep_until(give_up_at));
    return {.status = WaitStatus::kTimeout};
  }
  while (!sleep_until(due_at)) continue;
  WaitResult next = std::move(*pending_);
  pending_.reset();
  const FrameTime came_at = frame_time_from_ns(to_ns(read_monotonic_clock()));
  next.stamp = came_at;
  if (is_frame) next.lease.relabel(next.lease.frame().sequence, came_at);
  return next;
}

}  // namespace darkling
