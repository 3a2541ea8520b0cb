// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "base/camera_config.h"
#include "base/result.h"
#include "drivers/camera/pixel_formats.h"

namespace darkling {

// Whether the settings make sense for so many devices.
// @return kConfiguration with what does not fit.
[[nodiscard]] Result<void> check_camera_settings(const CameraConfig& config, std::size_t devices,
                                                 ImageExtent eye);

}  // namespace darkling
