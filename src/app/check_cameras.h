// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/check_rows.h"
#include "drivers/frame_source.h"
#include "geometry/stereo_rig.h"
#include "io/config.h"

namespace darkling {

// What can be looked through: a rig, and images where there are some.
struct CheckedEyes {
  std::optional<StereoRig> rig;
  std::unique_ptr<FrameSource> source;  // not started
};

// Adds the rows of the calibration and the camera. The calibration is that of the configuration's
// key; without it, what a recording or scene brings along.
// @param recording  SOURCE as typed; empty: the images are the configured camera's.
[[nodiscard]] CheckedEyes check_cameras(const Config& config, const std::string& recording,
                                        CheckRows& rows);

// Adds the row on whether both eyes see the same in the same row, from the first pairs.
void check_matching_rows(const OdometryConfig& config, const CheckedEyes& eyes, CheckRows& rows);

}  // namespace darkling
