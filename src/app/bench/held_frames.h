// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/open_source.h"
#include "base/stereo_frame.h"

namespace darkling {

// The good pairs of a recording, decoded or rendered into memory, so that only what is done with
// them is timed.
struct HeldFrames {
  std::string source;  // as the user named it
  StereoRig rig;
  std::vector<StereoFrame> frames;  // into `pixels`
  std::vector<std::vector<std::uint8_t>> pixels;
};

// @param show  is told how many frames of how many there are.
// @return any error of the source; kBadInput when it holds no good pair.
[[nodiscard]] Result<HeldFrames> hold_frames(
    const std::string& source, const OpenOptions& options,
    const std::function<void(std::int64_t done, std::int64_t count)>& show);

}  // namespace darkling
