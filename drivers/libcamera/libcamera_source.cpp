// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/libcamera_source.h"

#include <utility>

#include "drivers/camera/camera_settings.h"
#include "drivers/camera/stream_source.h"
#include "drivers/libcamera/libcamera_spec.h"
#include "drivers/libcamera/libcamera_streams.h"
#include "drivers/libcamera/load_libcamera.h"

namespace darkling {

namespace {

Result<std::vector<std::string>> checked_names(const CameraConfig& config, ImageExtent eye) {
  auto names = parse_libcamera(config.source);
  if (!names) return names;
  if (auto fits = check_camera_settings(config, names->size(), eye); !fits) {
    return tl::unexpected<Error>(fits.error());
  }
  return names;
}

}  // namespace

Result<std::unique_ptr<FrameSource>> create_libcamera_source(const CameraConfig& config,
                                                             ImageExtent eye) {
  if (const auto names = checked_names(config, eye); !names) {
    return tl::unexpected<Error>(names.error());
  }
  const auto calls = load_libcamera();
  if (!calls) return tl::unexpected<Error>(calls.error());
  return create_libcamera_source(config, eye, **calls);
}

Result<std::unique_ptr<FrameSource>> create_libcamera_source(const CameraConfig& config,
                                                             ImageExtent eye,
                                                             LibcameraCalls& calls) {
  auto names = checked_names(config, eye);
  if (!names) return tl::unexpected<Error>(names.error());
  return std::make_unique<StreamSource>(config, std::move(*names), eye,
                                        std::make_unique<LibcameraStreams>(calls));
}

}  // namespace darkling
