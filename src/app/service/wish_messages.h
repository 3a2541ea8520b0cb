// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/service/command_ring.h"
#include "base/result.h"
#include "base/time.h"
#include "drivers/framelog/frame_log.h"
#include "drivers/framelog/frame_log_writer.h"

namespace darkling {

// A wish that the odometry obeyed before the pair of this sequence.
struct RecordedWish {
  std::int64_t sequence = 0;
  Wish wish;
};

struct RecordedWishes {
  std::vector<RecordedWish> wishes;  // in the order in which they were obeyed
  std::int64_t unreadable = 0;       // messages that are none of ours, or ask for what cannot be
};

// Writes a wish into a frame log, as the message that it came by: on VO_COMMAND or VO_HINT.
// @param stamp  of the frame that it was taken before.
[[nodiscard]] Result<void> add_wish(FrameLogWriter& log, const Wish& wish, FrameTime stamp,
                                    std::int64_t utime_us);

// Writes again what read_wishes() read, to the bit. The times in the messages are lost, which mean
// nothing to a replay.
// @param stamp  of the frame that all of `wishes` were taken before.
[[nodiscard]] Result<void> add_wishes(FrameLogWriter& log, std::span<const RecordedWish> wishes,
                                      FrameTime stamp);

// All that add_wish() wrote, to the bit: obeyed again, they give the same estimates again. What
// came after the last pair is left out, and so are commands that are not for the odometry.
[[nodiscard]] RecordedWishes read_wishes(const FrameLog& log);

}  // namespace darkling
