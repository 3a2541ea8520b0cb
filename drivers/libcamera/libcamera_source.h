// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "base/camera_config.h"
#include "base/result.h"
#include "drivers/camera/pixel_formats.h"
#include "drivers/frame_source.h"
#include "drivers/libcamera/request_camera.h"

namespace darkling {

// Stereo pairs of the one or two cameras that "libcamera:NAME[,NAME]" names. Loads the library.
// @param eye  the calibration's size of one image, in px.
// @return kUsage when the source's text is wrong; kConfiguration when the settings do not fit it or
//   this program has no libcamera.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> create_libcamera_source(
    const CameraConfig& config, ImageExtent eye);

// @param calls  outlives the source.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> create_libcamera_source(
    const CameraConfig& config, ImageExtent eye, LibcameraCalls& calls);

}  // namespace darkling
