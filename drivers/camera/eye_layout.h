// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/camera_config.h"
#include "base/image_view.h"
#include "drivers/camera/pixel_formats.h"

namespace darkling {

// The size to ask a device for: the configured one; where that is 0, what gives eyes of `eye`.
[[nodiscard]] ImageExtent wanted_extent(const CameraConfig& config, PixelFormat format,
                                        ImageExtent eye);

// The size of one eye in a device's grey image; nothing (0x0) when it cannot be halved.
[[nodiscard]] ImageExtent eye_extent(EyeLayout layout, ImageExtent grey);

// The left and right eye of a shared image.
// @pre eye_extent() is not 0x0, and the layout is a shared one.
[[nodiscard]] std::array<ImageView<const std::uint8_t>, 2> split_eyes(
    EyeLayout layout, const ImageView<const std::uint8_t>& image);

}  // namespace darkling
