// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <libcamera/camera.h>

#include "base/camera_config.h"
#include "base/result.h"
#include "drivers/camera/pixel_formats.h"

namespace darkling {

struct ChosenFormat {
  std::unique_ptr<libcamera::CameraConfiguration> configuration;  // valid, of one stream
  ImageFormat format;
};

// The first of the camera's formats that is allowed and gives eyes of size `eye`.
// @return kDeviceUnavailable with what the camera offers.
[[nodiscard]] Result<ChosenFormat> choose_format(libcamera::Camera& camera,
                                                 const CameraConfig& config, ImageExtent eye);

}  // namespace darkling
