// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/service/command_ring.h"
#include "base/result.h"
#include "base/time.h"
#include "drivers/framelog/frame_log_writer.h"

namespace darkling {

// Writes a wish into a frame log, as the message that it came by: on VO_COMMAND or VO_HINT.
// @param stamp  of the frame that it was taken before.
[[nodiscard]] Result<void> add_wish(FrameLogWriter& log, const Wish& wish, FrameTime stamp,
                                    std::int64_t utime_us);

}  // namespace darkling
