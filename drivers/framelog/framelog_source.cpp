// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/framelog_source.h"

#include <algorithm>

#include "base/check.h"
#include "messages/checksum.h"

namespace darkling {

namespace {

std::size_t pixel_count(const FrameLogRow& row) {
  return static_cast<std::size_t>(row.width) * static_cast<std::size_t>(row.height);
}

std::size_t record_size(const FrameLogRow& row) {
  return kFrameHeadEnd + 2 * pixel_count(row);
}

}  // namespace

FramelogSource::FramelogSource(LogEvents events, std::vector<FrameLogRow> rows)
    : events_(std::move(events)), rows_(std::move(rows)) {}

Result<void> FramelogSource::start() {
  std::size_t largest = 0;
  for (const FrameLogRow& row : rows_) {
    if (row.fault == FrameFault::kNone) largest = std::max(largest, record_size(row));
  }
  slots_.emplace();
  for (Slot& slot : *slots_) slot.record.resize(largest);
  next_row_ = 0;
  last_stamp_.reset();
  stats_ = {};
  published_stats_.store(stats_);
  return {};
}

WaitResult FramelogSource::wait_next(Duration /*timeout*/) {
  CHECK(slots_.has_value(), "start() comes before wait_next()");
  if (next_row_ == rows_.size()) return {.status = WaitStatus::kEndOfSource};
  const auto slot = std::find_if(slots_->begin(), slots_->end(), [](const Slot& candidate) {
    return !candidate.is_on_loan.load(std::memory_order_acquire);
  });
  if (slot == slots_->end()) return {.status = WaitStatus::kTimeout};
  const FrameLogRow& row = rows_[next_row_++];
  FrameFault fault = row.fault;
  if (fault == FrameFault::kNone && !read_record(row, *slot)) fault = FrameFault::kUnreadable;
  if (fault == FrameFault::kNone) return deliver(row, static_cast<int>(slot - slots_->begin()));
  stats_.unreadable += fault == FrameFault::kUnreadable ? 1 : 0;
  stats_.wrong_size += fault == FrameFault::kWrongSize ? 1 : 0;
  stats_.unpaired += fault == FrameFault::kUnpaired ? 1 : 0;
  published_stats_.store(stats_);
  return {.status = WaitStatus::kBadFrame,
          .fault = fault,
          .sequence = row.sequence,
          .stamp = row.stamp};
}

bool FramelogSource::read_record(const FrameLogRow& row, Slot& slot) const {
  const auto record = std::span(slot.record).first(record_size(row));
  return events_.read_at(row.data_at, record) && is_record_sound(record);
}

WaitResult FramelogSource::deliver(const FrameLogRow& row, int slot_index) {
  Slot& slot = slots_->at(static_cast<std::size_t>(slot_index));
  slot.is_on_loan.store(true, std::memory_order_relaxed);
  ++stats_.delivered;
  if (last_stamp_ && row.stamp <= *last_stamp_) ++stats_.stamps_not_increasing;
  last_stamp_ = row.stamp;
  published_stats_.store(stats_);
  // The head was understood when the log was opened; behind it lie the two images.
  const auto* left = reinterpret_cast<const std::uint8_t*>(slot.record.data() + kFrameHeadEnd);
  const StereoFrame frame{.sequence = row.sequence,
                          .stamp = row.stamp,
                          .left = {left, row.width, row.height, row.width},
                          .right = {left + pixel_count(row), row.width, row.height, row.width}};
  return {.status = WaitStatus::kFrame, .lease = FrameLease(frame, &give_back, this, slot_index)};
}

void FramelogSource::give_back(void* source, int slot) {
  auto* self = static_cast<FramelogSource*>(source);
  self->slots_->at(static_cast<std::size_t>(slot))
      .is_on_loan.store(false, std::memory_order_release);
}

void FramelogSource::stop() {
  if (!slots_) return;
  for (const Slot& slot : *slots_) {
    CHECK(!slot.is_on_loan.load(std::memory_order_acquire), "every lease is back before stop()");
  }
  slots_.reset();
}

}  // namespace darkling
