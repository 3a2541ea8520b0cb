// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "vo/odometry_config.h"

namespace darkling {

// Compares a configuration and a thumbnail's size with vo/limits.h.
// @return kConfiguration with what was found and the limit's name and number.
[[nodiscard]] Result<void> check_limits(const OdometryConfig& config, int width_px, int height_px);

}  // namespace darkling
