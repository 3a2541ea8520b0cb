// SPDX-License-Identifier: Apache-2.0
#include "app/selected_frames.h"

namespace darkling {

SelectedFrames::SelectedFrames(std::unique_ptr<FrameSource> source, const OpenOptions& options)
    : source_(std::move(source)), options_(options) {}

Result<void> SelectedFrames::start() {
  stats_ = {};
  return source_->start();
}

WaitResult SelectedFrames::wait_next(Duration timeout) {
  for (;;) {
    WaitResult result = source_->wait_next(timeout);
    const bool is_frame = result.status == WaitStatus::kFrame;
    if (!is_frame && result.status != WaitStatus::kBadFrame) return result;
    const std::int64_t sequence = is_frame ? result.lease.frame().sequence : result.sequence;
    if (sequence >= options_.last) return {.status = WaitStatus::kEndOfSource};
    if (sequence < options_.first || (sequence - options_.first) % options_.stride != 0) continue;
    count(result);
    return result;
  }
}

// Stamps are left out: a source of which a part is taken has them in order.
void SelectedFrames::count(const WaitResult& result) {
  stats_.delivered += result.status == WaitStatus::kFrame ? 1 : 0;
  stats_.unreadable += result.fault == FrameFault::kUnreadable ? 1 : 0;
  stats_.wrong_size += result.fault == FrameFault::kWrongSize ? 1 : 0;
  stats_.unpaired += result.fault == FrameFault::kUnpaired ? 1 : 0;
}

}  // namespace darkling
