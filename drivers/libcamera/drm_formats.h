// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/camera_config.h"

namespace darkling {

// A pixel format as libcamera names it.
struct DrmFormat {
  std::uint32_t fourcc = 0;
  std::uint64_t modifier = 0;
  PixelFormat format = PixelFormat::kAny;  // how its first plane lies in memory
};

// Those that the driver can read, in the order in which they are tried: those without a copy first,
// those that halve the image last.
[[nodiscard]] std::span<const DrmFormat> drm_formats();

}  // namespace darkling
