// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/camera_config.h"
#include "base/result.h"
#include "drivers/camera/pixel_formats.h"
#include "drivers/v4l2/device_descriptor.h"

namespace darkling {

// @return kDeviceUnavailable when the node does not capture video into buffers.
[[nodiscard]] Result<void> check_captures(const DeviceDescriptor& device);

// Sets the device to the first of its formats that is allowed and gives eyes of size `eye`.
// @return kDeviceUnavailable when the node does not capture video, another program has it, or no
//   format fits; the message then lists what the device offers.
[[nodiscard]] Result<ImageFormat> negotiate_format(const DeviceDescriptor& device,
                                                   const CameraConfig& config, ImageExtent eye);

// Whether the device still delivers `format`. A device that does not answer does not.
[[nodiscard]] bool has_format(const DeviceDescriptor& device, const ImageFormat& format);

}  // namespace darkling
