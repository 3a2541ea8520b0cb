// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/service/wish_messages.h"
#include "base/result.h"
#include "drivers/frame_source.h"
#include "geometry/stereo_rig.h"
#include "io/trajectory.h"

namespace darkling {

// Which frames of a recording to use: [first, last), every `stride`-th of those.
struct OpenOptions {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();  // beyond the end: to the end
  std::int64_t stride = 1;
};

// Something to play, ready to start().
struct Recording {
  std::string name;  // of the folder or scene
  std::string kind;  // "KITTI", "EuRoC", "frame log" or "synthetic"
  std::unique_ptr<FrameSource> source;
  StereoRig rig;
  std::int64_t frame_count = 0;      // what will be played, bad frames included
  std::string calibration_path;      // what the rig was read from; empty when synthetic
  std::string truth_path;            // empty: the recording carries none
  std::optional<Trajectory> truth;   // known without a file of its own
  std::string damage;                // of the recording, in a sentence; empty: none is known
  std::vector<RecordedWish> wishes;  // that the odometry obeyed when it was recorded
};

// @param text  "A:B", the rows from A up to but without B, counted from 0; either may be left out.
// @return kUsage when it is not that, or B is not beyond A.
[[nodiscard]] Result<OpenOptions> parse_frame_range(std::string_view text, OpenOptions options);

// Opens SOURCE as `replay` takes it: a KITTI or EuRoC folder or a frame log, recognised by what it
// holds, or "synthetic:SCENE[,key=value…]".
// @return kNoInput when it or a part of it is absent, kBadInput when it makes no sense, kUsage when
//         `options` leave no frame, kConfiguration when the calibration is wrong.
[[nodiscard]] Result<Recording> open_source(std::string_view text, const OpenOptions& options);

}  // namespace darkling
