// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_source.h"

#include <utility>

#include "drivers/camera/camera_settings.h"
#include "drivers/v4l2/v4l2_spec.h"
#include "drivers/v4l2/v4l2_streams.h"

namespace darkling {

Result<std::unique_ptr<V4l2Source>> V4l2Source::create(const CameraConfig& config, ImageExtent eye,
                                                       DeviceCalls& calls) {
  auto paths = parse_v4l2(config.source);
  if (!paths) return tl::unexpected<Error>(paths.error());
  if (auto fits = check_camera_settings(config, paths->size(), eye); !fits) {
    return tl::unexpected<Error>(fits.error());
  }
  return std::unique_ptr<V4l2Source>(
      new V4l2Source(config, std::move(*paths), eye, std::make_unique<V4l2Streams>(calls)));
}

}  // namespace darkling
