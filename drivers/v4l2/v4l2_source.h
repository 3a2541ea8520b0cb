// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/stream_source.h"
#include "drivers/v4l2/v4l2_device.h"

namespace darkling {

// Stereo pairs of one V4L2 device that shows both eyes in an image, or of two devices.
// Thread: as its base says.
class V4l2Source final : public StreamSource {
 public:
  // @param eye  the calibration's size of one image, in px.
  // @return kUsage when the source's text is wrong, kConfiguration when the settings do not fit it.
  static Result<std::unique_ptr<V4l2Source>> create(const CameraConfig& config, ImageExtent eye,
                                                    DeviceCalls& calls = linux_device_calls());

 private:
  using StreamSource::StreamSource;
};

}  // namespace darkling
