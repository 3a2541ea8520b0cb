// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "base/result.h"
#include "drivers/frame_source.h"
#include "geometry/stereo_rig.h"
#include "io/config.h"

namespace darkling {

// Where the service takes its frames from; no device is open yet.
struct LiveCamera {
  std::string name;  // as configured
  std::unique_ptr<FrameSource> source;
  StereoRig rig;
};

// Finds what `camera` of the configuration names, and the calibration that goes with it.
// @return kConfiguration when the text makes no sense or the calibration is missing or wrong, and
//         what stands in for a camera has its own errors.
[[nodiscard]] Result<LiveCamera> open_camera(const Config& config);

}  // namespace darkling
