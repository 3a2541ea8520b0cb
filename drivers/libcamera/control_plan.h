// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_config.h"
#include "base/time.h"

namespace darkling {

struct ControlRange {
  double least = 0.0;
  double most = 0.0;
};

// Which of the controls of exposure and rate a camera has.
struct CameraControls {
  bool has_automatic = false;  // an automatic that can be switched on and off
  std::optional<ControlRange> exposure_us;
  std::optional<ControlRange> gain;
  std::optional<ControlRange> period_us;
};

// What they are set to; nothing: left alone.
struct ControlPlan {
  std::optional<bool> is_automatic;  // of whatever of exposure and gain is not fixed below
  std::optional<std::int32_t> exposure_us;
  std::optional<float> gain;
  std::optional<std::int64_t> period_us;  // shortest and longest alike
  std::vector<std::string> remarks;       // a sentence for whatever is not as asked
};

// A fixed frame period also bounds an automatic exposure, which then cannot lower the rate; a fixed
// exposure is held below max_exposure_ms and the period.
// @param name  of the camera, for the remarks.
[[nodiscard]] ControlPlan plan_controls(const std::string& name, const CameraConfig& config,
                                        const CameraControls& controls);

}  // namespace darkling
