// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/controls.h>

#include "drivers/libcamera/completed_frames.h"
#include "drivers/libcamera/control_plan.h"

namespace darkling {

[[nodiscard]] CameraControls read_controls(const libcamera::ControlInfoMap& known);

// What the plan says, in libcamera's terms.
[[nodiscard]] libcamera::ControlList control_list(const libcamera::ControlInfoMap& known,
                                                  const ControlPlan& plan);

// Takes over what a completed request says of exposure, gain, period and time.
void read_metadata(const libcamera::ControlList& metadata, CompletedFrame& frame);

}  // namespace darkling
