// SPDX-License-Identifier: Apache-2.0
// The part of StreamSource that runs for every frame; nothing here claims memory.
#include <algorithm>

#include "drivers/camera/eye_layout.h"
#include "drivers/camera/stream_source.h"

namespace darkling {

namespace {

// How soon a buffer that came back while a camera had none goes to the camera.
constexpr Duration kReturnCheck = std::chrono::milliseconds(2);

}  // namespace

WaitResult StreamSource::wait_next(Duration timeout) {
  CHECK(streams_[0] != nullptr, "start() comes before wait_next()");
  const MonotonicTime deadline = cameras_->now() + timeout;
  for (bool is_over = false;;) {
    reclaim_slots();
    if (Slot* slot = free_slot(); slot != nullptr && !is_lost()) {
      WaitResult result = streams_[1] == nullptr ? next_shared(*slot) : next_pair(*slot);
      if (result.status != WaitStatus::kUnknown) return result;
    }
    if (is_lost()) return {.status = WaitStatus::kDeviceLost};
    if (is_over) return {.status = WaitStatus::kTimeout};
    const Duration left = std::max(deadline - cameras_->now(), Duration::zero());
    is_over = left == Duration::zero();  // after one last look
    wait_for_streams(left);
  }
}

bool StreamSource::is_lost() const {
  return std::any_of(streams_.begin(), streams_.end(),
                     [](const auto& stream) { return stream != nullptr && stream->is_lost(); });
}

void StreamSource::reclaim_slots() {
  for (Slot& slot : slots_) {
    if (slot.state.load(std::memory_order_acquire) != SlotState::kReturned) continue;
    give_buffers_back(slot);
    slot.state.store(SlotState::kFree, std::memory_order_relaxed);
  }
}

void StreamSource::give_buffers_back(Slot& slot) {
  for (std::size_t i = 0; i < slot.buffers.size(); ++i) {
    if (slot.buffers[i] >= 0) streams_[i]->give_back(slot.buffers[i]);
    slot.buffers[i] = -1;
  }
}

StreamSource::Slot* StreamSource::free_slot() {
  auto* slot = std::find_if(slots_.begin(), slots_.end(), [](const Slot& candidate) {
    return candidate.state.load(std::memory_order_relaxed) == SlotState::kFree;
  });
  return slot == slots_.end() ? nullptr : slot;
}

void StreamSource::wait_for_streams(Duration timeout) {
  const bool has_slot = free_slot() != nullptr;
  bool is_starved = !has_slot;
  std::array<CameraStream*, 2> wanted = {};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (streams_[i] == nullptr) continue;
    const bool has_buffer = streams_[i]->queued_count() > 0;
    is_starved = is_starved || !has_buffer;
    if (has_slot) wanted[i] = streams_[i].get();
  }
  cameras_->wait(wanted, is_starved ? std::min(timeout, kReturnCheck) : timeout);
}

TakenFrame StreamSource::take_from(std::size_t camera, std::int64_t& index) {
  TakenFrame frame = streams_[camera]->take();
  if (frame.taken != Taken::kFrame && frame.taken != Taken::kBadBuffer) return frame;
  index = indices_[camera].advance(frame.sequence);
  stats_.dropped_by_device += indices_[camera].lost();
  stats_.device_errors += frame.taken == Taken::kBadBuffer ? 1 : 0;
  stats_.stamps_of_future += frame.is_of_future ? 1 : 0;
  published_stats_.store(stats_);
  return frame;
}

ImageView<const std::uint8_t> StreamSource::bring(std::size_t camera, int buffer, Slot& slot) {
  CameraStream& from = *streams_[camera];
  const ImageFormat& format = from.format();
  const ImageExtent grey = grey_extent(format.format, format.extent);
  if (is_grey_in_place(format.format)) {
    slot.buffers[camera] = buffer;
    return {from.pixels(buffer), grey.width, grey.height, format.stride_bytes};
  }
  const ImageView<std::uint8_t> copy(slot.copies[camera].data(), grey.width, grey.height,
                                     grey.width);
  bool is_whole = true;
  if (decoders_[camera]) {
    is_whole = decoders_[camera]->decode({from.pixels(buffer), from.filled_bytes(buffer)}, copy);
  } else {
    to_grey(format.format, from.pixels(buffer), format.stride_bytes, copy);
  }
  from.give_back(buffer);
  if (!is_whole) return {};
  return copy;
}

WaitResult StreamSource::next_shared(Slot& slot) {
  std::int64_t index = 0;
  const TakenFrame taken = take_from(0, index);
  if (taken.taken != Taken::kFrame && taken.taken != Taken::kBadBuffer) return {};
  const std::int64_t number = numbers_.number_pair(index, index);
  if (taken.taken == Taken::kBadBuffer) return report_unreadable(number, taken.stamp);
  const ImageView<const std::uint8_t> image = bring(0, taken.buffer, slot);
  if (image.is_empty()) return report_unreadable(number, taken.stamp);
  auto eyes = split_eyes(config_.layout, image);
  if (config_.swap_eyes) std::swap(eyes[0], eyes[1]);
  return lend({.sequence = number, .stamp = taken.stamp, .left = eyes[0], .right = eyes[1]}, slot);
}

WaitResult StreamSource::next_pair(Slot& slot) {
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

void StreamSource::take_eyes() {
  for (const Eye eye : {Eye::kLeft, Eye::kRight}) {
    StampedFrame frame;
    const TakenFrame taken = take_from(static_cast<std::size_t>(eye), frame.index);
    if (taken.taken != Taken::kFrame) continue;
    frame.stamp = taken.stamp;
    frame.buffer = taken.buffer;
    pairing_->push(eye, frame);
  }
}

WaitResult StreamSource::deliver_pair(const PairResult& pair, Slot& slot) {
  last_skew_ = pair.right.stamp - pair.left.stamp;
  const StereoFrame frame{.sequence = numbers_.number_pair(pair.left.index, pair.right.index),
                          .stamp = pair.left.stamp,
                          .left = bring(0, pair.left.buffer, slot),
                          .right = bring(1, pair.right.buffer, slot)};
  if (!frame.left.is_empty() && !frame.right.is_empty()) return lend(frame, slot);
  give_buffers_back(slot);
  return report_unreadable(frame.sequence, frame.stamp);
}

WaitResult StreamSource::report_unreadable(std::int64_t number, FrameTime stamp) {
  ++stats_.unreadable;
  published_stats_.store(stats_);
  return {.status = WaitStatus::kBadFrame,
          .fault = FrameFault::kUnreadable,
          .sequence = number,
          .stamp = stamp};
}

WaitResult StreamSource::report_unpaired(Eye eye, const StampedFrame& frame) {
  streams_[static_cast<std::size_t>(eye)]->give_back(frame.buffer);
  const NumberPairs::Missing missing = numbers_.number_unpaired(eye, frame.index);
  if (!missing.is_new) return {};
  ++stats_.unpaired;
  published_stats_.store(stats_);
  return {.status = WaitStatus::kBadFrame,
          .fault = FrameFault::kUnpaired,
          .sequence = missing.number,
          .stamp = frame.stamp};
}

WaitResult StreamSource::lend(const StereoFrame& frame, Slot& slot) {
  slot.state.store(SlotState::kOnLoan, std::memory_order_relaxed);
  ++stats_.delivered;
  if (last_stamp_ && frame.stamp <= *last_stamp_) ++stats_.stamps_not_increasing;
  last_stamp_ = frame.stamp;
  published_stats_.store(stats_);
  for (const auto& stream : streams_) {
    if (stream != nullptr) stream->refresh_exposure();
  }
  CameraState camera = streams_[0]->state();
  camera.last_skew = last_skew_;
  published_camera_.store(camera);
  return {.status = WaitStatus::kFrame,
          .lease = FrameLease(frame, &give_back, this, static_cast<int>(&slot - slots_.data()))};
}

void StreamSource::give_back(void* source, int slot) {
  auto* self = static_cast<StreamSource*>(source);
  self->slots_.at(slot).state.store(SlotState::kReturned, std::memory_order_release);
}

}  // namespace darkling
