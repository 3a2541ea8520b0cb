// SPDX-License-Identifier: Apache-2.0
#include "drivers/injection/injected_source.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "drivers/injection/pixels.h"

namespace darkling {

InjectedSource::InjectedSource(std::unique_ptr<FrameSource> source, ImageSize size,
                               const std::vector<Injection>& injections)
    : source_(std::move(source)), size_(size) {
  for (const Injection& injection : injections) {
    stages_.push_back({.injection = injection, .injector = injection.kind->make(injection)});
  }
}

Result<void> InjectedSource::start() {
  const std::size_t pixel_count = static_cast<std::size_t>(size_.width) * size_.height;
  for (Slot& slot : slots_) slot.pixels.resize(2 * pixel_count);
  for (const Stage& stage : stages_) stage.injector->start(size_);
  lost_unreadable_ = 0;
  lost_wrong_size_ = 0;
  return source_->start();
}

WaitResult InjectedSource::wait_next(Duration timeout) {
  const auto slot = std::find_if(slots_.begin(), slots_.end(), [](const Slot& candidate) {
    return !candidate.is_on_loan.load(std::memory_order_acquire);
  });
  if (slot == slots_.end()) return {.status = WaitStatus::kTimeout};
  WaitResult next = source_->wait_next(timeout);
  if (next.status != WaitStatus::kFrame) return next;
  const StereoFrame& frame = next.lease.frame();
  InjectedPair pair;
  const FrameFault fault = copy_and_inject(frame, *slot, pair);
  if (fault != FrameFault::kNone) return lose(frame, fault);
  slot->is_on_loan.store(true, std::memory_order_relaxed);
  const StereoFrame injected{
      .sequence = pair.sequence, .stamp = pair.stamp, .left = pair.left, .right = pair.right};
  return {.status = WaitStatus::kFrame,
          .lease = FrameLease(injected, &give_back, this, static_cast<int>(slot - slots_.begin()))};
}

FrameFault InjectedSource::copy_and_inject(const StereoFrame& frame, Slot& slot,
                                           InjectedPair& pair) {
  const auto [width, height] = size_;
  if (!frame.left.has_size(width, height) || !frame.right.has_size(width, height)) {
    return FrameFault::kWrongSize;
  }
  std::uint8_t* right = slot.pixels.data() + slot.pixels.size() / 2;
  pair = {.sequence = frame.sequence,
          .stamp = frame.stamp,
          .left = {slot.pixels.data(), width, height, width},
          .right = {right, width, height, width}};
  copy_pixels(frame.left, pair.left);
  copy_pixels(frame.right, pair.right);
  for (const Stage& stage : stages_) {
    if (!stage.injection.is_due(pair.sequence)) {
      stage.injector->pass(pair);
      continue;
    }
    const FrameFault fault = stage.injector->inject(pair);
    if (fault != FrameFault::kNone) return fault;
  }
  return FrameFault::kNone;
}

WaitResult InjectedSource::lose(const StereoFrame& frame, FrameFault fault) {
  ++(fault == FrameFault::kWrongSize ? lost_wrong_size_ : lost_unreadable_);
  return {.status = WaitStatus::kBadFrame,
          .fault = fault,
          .sequence = frame.sequence,
          .stamp = frame.stamp};
}

void InjectedSource::give_back(void* source, int slot) {
  auto* self = static_cast<InjectedSource*>(source);
  self->slots_.at(static_cast<std::size_t>(slot))
      .is_on_loan.store(false, std::memory_order_release);
}

void InjectedSource::stop() {
  for (const Slot& slot : slots_) {
    CHECK(!slot.is_on_loan.load(std::memory_order_acquire), "every lease is back before stop()");
  }
  source_->stop();
}

SourceStats InjectedSource::stats() const {
  SourceStats stats = source_->stats();
  stats.delivered -= lost_unreadable_ + lost_wrong_size_;
  stats.unreadable += lost_unreadable_;
  stats.wrong_size += lost_wrong_size_;
  return stats;
}

}  // namespace darkling
