// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/camera_config.h"
#include "base/time.h"
#include "drivers/v4l2/device_descriptor.h"

namespace darkling {

// What a device says of its exposure; -1: it does not say.
struct ExposureReading {
  double exposure_ms = -1.0;
  double gain = -1.0;  // in the device's own units
};

// Asks for a frame rate and reads back what came of it.
// @param remarks  gets a sentence when the device is slower than asked, or does not say.
// @return the frame period; 0 when the device does not say.
[[nodiscard]] Duration set_frame_rate(const DeviceDescriptor& device, double rate_hz,
                                      std::vector<std::string>& remarks);

// Sets exposure and gain to fixed values or to the camera's own automatic, which is never allowed
// to lower the frame rate for a longer exposure. A fixed exposure is held below max_exposure_ms and
// the period; V4L2 has no such bound for an automatic one.
// @param remarks  gets a sentence for whatever is not as asked. Controls that the device lacks are
//   no error.
void set_exposure(const DeviceDescriptor& device, const CameraConfig& config, Duration period,
                  std::vector<std::string>& remarks);

// Cost: two requests to the device, over USB a few ms. No heap.
[[nodiscard]] ExposureReading read_exposure(const DeviceDescriptor& device);

}  // namespace darkling
