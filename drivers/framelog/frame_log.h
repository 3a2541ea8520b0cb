// SPDX-License-Identifier: Apache-2.0
// What a frame log holds, listed once when it is opened: docs/frame_log.md describes the layout.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "drivers/frame_source.h"
#include "drivers/framelog/log_events.h"
#include "geometry/stereo_rig.h"
#include "messages/rig_t.hpp"
#include "messages/truth_t.hpp"

namespace darkling {

// A frame, or a pair that is known to be missing.
struct FrameLogRow {
  std::int64_t sequence = 0;             // grows from row to row, at most 2^52
  FrameTime stamp;                       // at most 2^61 ns from 0
  FrameFault fault = FrameFault::kNone;  // else there is nothing to read
  std::int64_t data_at = 0;              // where its record begins in the file, bytes
  int width = 0;                         // px, of each eye
  int height = 0;
};

// A message to the odometry that was recorded between rows: on VO_COMMAND or VO_HINT. It may say
// anything at all.
struct FrameLogMessage {
  const char* channel = nullptr;  // kCommandChannel or kHintChannel
  std::size_t row = 0;            // of the first pair behind it; the number of rows: there is none
  std::int64_t data_at = 0;       // where it begins in the file, bytes
  std::int32_t data_size = 0;     // bytes
};

struct FrameLog {
  LogEvents events;
  rig_t record = {};  // with the texts
  StereoRig rig = {};
  std::optional<truth_t> truth = {};  // count, keys and poses agree
  std::vector<FrameLogRow> rows = {};
  std::vector<FrameLogMessage> messages = {};  // as they came
  // Records that are damaged and cannot be told to be a frame's, and those of other channels.
  std::int64_t damaged_records = 0;
  std::int64_t other_records = 0;
};

// Walks through the log without reading its pixels. Frames whose head is damaged become rows with a
// fault, in their place.
// @return kNoInput when it is absent, unreadable or empty; kBadInput when it is no frame log, or
//         its rig is damaged or cannot be.
// Cost: four reads of the file an event.
[[nodiscard]] Result<FrameLog> open_frame_log(const std::string& path);

// What is wrong with the log in one sentence, or empty.
[[nodiscard]] std::string describe_damage(const FrameLog& log);

}  // namespace darkling
