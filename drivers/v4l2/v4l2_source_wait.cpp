// SPDX-License-Identifier: Apache-2.0
// The part of V4l2Source that runs for every frame; nothing here claims memory.
#include <algorithm>

#include "drivers/v4l2/eye_layout.h"
#include "drivers/v4l2/v4l2_source.h"

namespace darkling {

namespace {

// How soon a buffer that came back while a device had none goes to the device.
constexpr Duration kReturnCheck = std::chrono::milliseconds(2);

}  // namespace

WaitResult V4l2Source::wait_next(Duration timeout) {
  CHECK(devices_[0] != nullptr, "start() comes before wait_next()");
  const MonotonicTime deadline = calls_.now() + timeout;
  for (bool is_over = false;;) {
    reclaim_slots();
    if (Slot* slot = free_slot(); slot != nullptr && !is_lost()) {
      WaitResult result = devices_[1] == nullptr ? next_shared(*slot) : next_pair(*slot);
      if (result.status != WaitStatus::kUnknown) return result;
    }
    if (is_lost()) return {.status = WaitStatus::kDeviceLost};
    if (is_over) return {.status = WaitStatus::kTimeout};
    const Duration left = std::max(deadline - calls_.now(), Duration::zero());
    is_over = left == Duration::zero();  // after one last look
    wait_for_devices(left);
  }
}

bool V4l2Source::is_lost() const {
  return std::any_of(devices_.begin(), devices_.end(),
                     [](const auto& device) { return device != nullptr && device->is_lost(); });
}

void V4l2Source::reclaim_slots() {
  for (Slot& slot : slots_) {
    if (slot.state.load(std::memory_order_acquire) != SlotState::kReturned) continue;
    for (std::size_t i = 0; i < slot.buffers.size(); ++i) {
      if (slot.buffers[i] >= 0) devices_[i]->give_back(slot.buffers[i]);
      slot.buffers[i] = -1;
    }
    slot.state.store(SlotState::kFree, std::memory_order_relaxed);
  }
}

V4l2Source::Slot* V4l2Source::free_slot() {
  auto* slot = std::find_if(slots_.begin(), slots_.end(), [](const Slot& candidate) {
    return candidate.state.load(std::memory_order_relaxed) == SlotState::kFree;
  });
  return slot == slots_.end() ? nullptr : slot;
}

void V4l2Source::wait_for_devices(Duration timeout) {
  const bool has_slot = free_slot() != nullptr;
  bool is_starved = !has_slot;
  std::array<pollfd, 2> wanted = {{{.fd = -1, .events = 0, .revents = 0},  // -1: passed over
                                   {.fd = -1, .events = 0, .revents = 0}}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (devices_[i] == nullptr) continue;
    // Older kernels call it an error to wait for a device that has no buffer.
    const bool has_buffer = devices_[i]->queued_count() > 0;
    is_starved = is_starved || !has_buffer;
    if (!has_slot || !has_buffer) continue;
    wanted[i].fd = devices_[i]->descriptor();
    wanted[i].events = POLLIN | POLLPRI;
  }
  const int ready = calls_.poll(wanted, is_starved ? std::min(timeout, kReturnCheck) : timeout);
  if (ready <= 0) return;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i].fd < 0) continue;
    devices_[i]->note_events(wanted[i].revents);
    is_readable_[i] = (wanted[i].revents & POLLIN) != 0;
  }
}

TakenFrame V4l2Source::take_from(std::size_t device, std::int64_t& index) {
  if (!is_readable_[device]) return {};
  is_readable_[device] = false;
  TakenFrame frame = devices_[device]->take();
  if (frame.taken != Taken::kFrame && frame.taken != Taken::kBadBuffer) return frame;
  index = indices_[device].advance(frame.sequence);
  stats_.dropped_by_device += indices_[device].lost();
  stats_.device_errors += frame.taken == Taken::kBadBuffer ? 1 : 0;
  published_stats_.store(stats_);
  return frame;
}

ImageView<const std::uint8_t> V4l2Source::bring(std::size_t device, int buffer, Slot& slot) {
  V4l2Device& from = *devices_[device];
  const ImageFormat& format = from.format();
  const ImageExtent grey = grey_extent(format.format, format.extent);
  if (is_grey_in_place(format.format)) {
    slot.buffers[device] = buffer;
    return {from.pixels(buffer), grey.width, grey.height, format.stride_bytes};
  }
  const ImageView<std::uint8_t> copy(slot.copies[device].data(), grey.width, grey.height,
                                     grey.width);
  to_grey(format.format, from.pixels(buffer), format.stride_bytes, copy);
  from.give_back(buffer);
  return copy;
}

WaitResult V4l2Source::next_shared(Slot& slot) {
  std::int64_t index = 0;
  const TakenFrame taken = take_from(0, index);
  if (taken.taken != Taken::kFrame && taken.taken != Taken::kBadBuffer) return {};
  const std::int64_t number = numbers_.number_pair(index, index);
  if (taken.taken == Taken::kBadBuffer) {
    ++stats_.unreadable;
    published_stats_.store(stats_);
    return {.status = WaitStatus::kBadFrame,
            .fault = FrameFault::kUnreadable,
            .sequence = number,
            .stamp = taken.stamp};
  }
  auto eyes = split_eyes(config_.layout, bring(0, taken.buffer, slot));
  if (config_.swap_eyes) std::swap(eyes[0], eyes[1]);
  return lend({.sequence = number, .stamp = taken.stamp, .left = eyes[0], .right = eyes[1]}, slot);
}

WaitResult V4l2Source::next_pair(Slot& slot) {
  PairResult pair = pairing_->next();
  if (pair.outcome == PairOutcome::kNothing) {
    take_eyes();
    pair = pairing_->next();
  }
  while (pair.outcome != PairOutcome::kNothing) {
    if (pair.outcome == PairOutcome::kPair) return deliver_pair(pair, slot);
    const bool is_left = pair.outcome == PairOutcome::kUnpairedLeft;
    WaitResult missing =
        report_unpaired(is_left ? Eye::kLeft : Eye::kRight, is_left ? pair.left : pair.right);
    if (missing.status != WaitStatus::kUnknown) return missing;
    pair = pairing_->next();
  }
  return {};
}

void V4l2Source::take_eyes() {
  for (const Eye eye : {Eye::kLeft, Eye::kRight}) {
    StampedFrame frame;
    const TakenFrame taken = take_from(static_cast<std::size_t>(eye), frame.index);
    if (taken.taken != Taken::kFrame) continue;
    frame.stamp = taken.stamp;
    frame.buffer = taken.buffer;
    pairing_->push(eye, frame);
  }
}

WaitResult V4l2Source::deliver_pair(const PairResult& pair, Slot& slot) {
  last_skew_ = pair.right.stamp - pair.left.stamp;
  const StereoFrame frame{.sequence = numbers_.number_pair(pair.left.index, pair.right.index),
                          .stamp = pair.left.stamp,
                          .left = bring(0, pair.left.buffer, slot),
                          .right = bring(1, pair.right.buffer, slot)};
  return lend(frame, slot);
}

WaitResult V4l2Source::report_unpaired(Eye eye, const StampedFrame& frame) {
  devices_[static_cast<std::size_t>(eye)]->give_back(frame.buffer);
  const NumberPairs::Missing missing = numbers_.number_unpaired(eye, frame.index);
  if (!missing.is_new) return {};
  ++stats_.unpaired;
  published_stats_.store(stats_);
  return {.status = WaitStatus::kBadFrame,
          .fault = FrameFault::kUnpaired,
          .sequence = missing.number,
          .stamp = frame.stamp};
}

WaitResult V4l2Source::lend(const StereoFrame& frame, Slot& slot) {
  slot.state.store(SlotState::kOnLoan, std::memory_order_relaxed);
  ++stats_.delivered;
  if (last_stamp_ && frame.stamp <= *last_stamp_) ++stats_.stamps_not_increasing;
  last_stamp_ = frame.stamp;
  published_stats_.store(stats_);
  for (const auto& device : devices_) {
    if (device != nullptr) device->refresh_exposure();
  }
  CameraState camera = devices_[0]->state();
  camera.last_skew = last_skew_;
  published_camera_.store(camera);
  return {.status = WaitStatus::kFrame,
          .lease = FrameLease(frame, &give_back, this, static_cast<int>(&slot - slots_.data()))};
}

void V4l2Source::give_back(void* source, int slot) {
  auto* self = static_cast<V4l2Source*>(source);
  self->slots_.at(slot).state.store(SlotState::kReturned, std::memory_order_release);
}

}  // namespace darkling
