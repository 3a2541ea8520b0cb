// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <vector>

#include "drivers/dataset/dataset_rows.h"
#include "drivers/dataset/read_image.h"
#include "drivers/frame_source.h"
#include "drivers/published_state.h"

namespace darkling {

// Plays the rows of a recorded data set in their order, as fast as they are asked for. Buffers are
// claimed by start() and reused.
class DatasetSource final : public FrameSource {
 public:
  // How many frames may be on loan at once; wait_next() times out while all are.
  static constexpr int kSlotCount = 3;

  // @param size  what both images of every pair must measure, in px.
  DatasetSource(std::vector<DatasetRow> rows, ImageSize size);

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] SourceStats stats() const override { return published_stats_.load(); }

 private:
  struct Slot {
    ImageBuffer left;
    ImageBuffer right;
    std::atomic<bool> is_on_loan;  // false at first
  };

  [[nodiscard]] FrameFault read_pair(const DatasetRow& row, Slot& slot) const;
  [[nodiscard]] WaitResult deliver(const DatasetRow& row, int slot_index);
  static void give_back(void* source, int slot);

  std::vector<DatasetRow> rows_;
  ImageSize size_;
  std::optional<std::array<Slot, kSlotCount>> slots_;
  std::size_t next_row_ = 0;
  std::optional<FrameTime> last_stamp_;  // of the pair delivered last
  SourceStats stats_;
  PublishedStats published_stats_;
};

}  // namespace darkling
