// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <vector>

#include "drivers/frame_source.h"
#include "drivers/framelog/frame_log.h"
#include "drivers/published_state.h"

namespace darkling {

// Plays the rows of a frame log in their order, as fast as they are asked for. Buffers are claimed
// by start() and reused; pixels stay where the record was read into.
class FramelogSource final : public FrameSource {
 public:
  // How many frames may be on loan at once; wait_next() times out while all are.
  static constexpr int kSlotCount = 3;

  // @param rows  some or all of the log's, in their order.
  FramelogSource(LogEvents events, std::vector<FrameLogRow> rows);

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] SourceStats stats() const override { return published_stats_.load(); }

 private:
  struct Slot {
    std::vector<std::byte> record;
    std::atomic<bool> is_on_loan;  // false at first
  };

  [[nodiscard]] bool read_record(const FrameLogRow& row, Slot& slot) const;
  [[nodiscard]] WaitResult deliver(const FrameLogRow& row, int slot_index);
  static void give_back(void* source, int slot);

  LogEvents events_;
  std::vector<FrameLogRow> rows_;
  std::optional<std::array<Slot, kSlotCount>> slots_;
  std::size_t next_row_ = 0;
  std::optional<FrameTime> last_stamp_;  // of the pair delivered last
  SourceStats stats_;
  PublishedStats published_stats_;
};

}  // namespace darkling
