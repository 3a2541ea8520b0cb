// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/camera_settings.h"

#include <string>

namespace darkling {

Result<void> check_camera_settings(const CameraConfig& config, std::size_t devices,
                                   ImageExtent eye) {
  const bool is_shared = config.layout != EyeLayout::kTwoDevices;
  if (is_shared != (devices == 1)) {
    return failure(ExitCode::kConfiguration,
                   config.source + " names " + std::to_string(devices) +
                       (is_shared ? " devices, but the layout is of one image with both eyes"
                                  : " device, but the layout is of two devices"));
  }
  if (eye.width <= 0 || eye.height <= 0 || config.width_px < 0 || config.height_px < 0) {
    return failure(ExitCode::kConfiguration, config.source + ": an image size is not positive");
  }
  constexpr double kMaxRate_hz = 1000.0;
  if (!(config.rate_hz > 0.0 && config.rate_hz <= kMaxRate_hz)) {
    return failure(ExitCode::kConfiguration,
                   config.source + ": the frame rate must be above 0 and at most 1000 a second");
  }
  if (!(config.exposure_ms >= 0.0 && config.max_exposure_ms > 0.0 && config.gain >= 0.0 &&
        config.max_skew_ms >= 0.0)) {
    return failure(ExitCode::kConfiguration,
                   config.source +
                       ": exposure, gain and skew must not be negative, and the "
                       "longest exposure must be above 0");
  }
  return {};
}

}  // namespace darkling
