// SPDX-License-Identifier: Apache-2.0
#include "drivers/dataset/dataset_source.h"

#include <algorithm>

namespace darkling {

DatasetSource::DatasetSource(std::vector<DatasetRow> rows, ImageSize size)
    : rows_(std::move(rows)), size_(size) {}

Result<void> DatasetSource::start() {
  slots_.emplace();
  next_row_ = 0;
  last_stamp_.reset();
  stats_ = {};
  published_stats_.store(stats_);
  return {};
}

WaitResult DatasetSource::wait_next(Duration /*timeout*/) {
  CHECK(slots_.has_value(), "start() comes before wait_next()");
  if (next_row_ == rows_.size()) return {.status = WaitStatus::kEndOfSource};
  const auto slot = std::find_if(slots_->begin(), slots_->end(), [](const Slot& candidate) {
    return !candidate.is_on_loan.load(std::memory_order_acquire);
  });
  if (slot == slots_->end()) return {.status = WaitStatus::kTimeout};
  const DatasetRow& row = rows_[next_row_++];
  const FrameFault fault = read_pair(row, *slot);
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

FrameFault DatasetSource::read_pair(const DatasetRow& row, Slot& slot) const {
  if (row.left_path.empty() || row.right_path.empty()) return FrameFault::kUnpaired;
  if (!slot.left.read(row.left_path) || !slot.right.read(row.right_path)) {
    return FrameFault::kUnreadable;
  }
  const bool has_size = slot.left.image().has_size(size_.width, size_.height) &&
                        slot.right.image().has_size(size_.width, size_.height);
  return has_size ? FrameFault::kNone : FrameFault::kWrongSize;
}

WaitResult DatasetSource::deliver(const DatasetRow& row, int slot_index) {
  Slot& slot = slots_->at(slot_index);
  slot.is_on_loan.store(true, std::memory_order_relaxed);
  ++stats_.delivered;
  if (last_stamp_ && row.stamp <= *last_stamp_) ++stats_.stamps_not_increasing;
  last_stamp_ = row.stamp;
  published_stats_.store(stats_);
  const StereoFrame frame{.sequence = row.sequence,
                          .stamp = row.stamp,
                          .left = slot.left.image(),
                          .right = slot.right.image()};
  return {.status = WaitStatus::kFrame, .lease = FrameLease(frame, &give_back, this, slot_index)};
}

void DatasetSource::give_back(void* source, int slot) {
  auto* self = static_cast<DatasetSource*>(source);
  self->slots_->at(slot).is_on_loan.store(false, std::memory_order_release);
}

void DatasetSource::stop() {
  if (!slots_) return;
  for (const Slot& slot : *slots_) {
    CHECK(!slot.is_on_loan.load(std::memory_order_acquire), "every lease is back before stop()");
  }
  slots_.reset();
}

}  // namespace darkling
