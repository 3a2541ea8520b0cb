// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"
#include "base/time.h"

namespace darkling {

// One exposure of both eyes as the camera gave it: 8-bit grey, neither rectified nor reduced.
struct StereoFrame {
  std::int64_t sequence = 0;  // position in the source; a gap means pairs that were lost
  FrameTime stamp;            // mid-exposure of the left image
  ImageView<const std::uint8_t> left;
  ImageView<const std::uint8_t> right;
};

}  // namespace darkling
