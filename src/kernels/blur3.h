// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// Blurs with the binomial kernel [1 2 1]ᵀ[1 2 1] / 16, a Gaussian of σ = 0.71 px: what takes the
// pixel noise off before neighbours are compared. Beyond the border the nearest pixel stands in.
// @param dst  same size as `src`; may not overlap it.
// Exactness: rounds once, half up; every variant equals the reference bit for bit.
using Blur3Fn = void(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst);

Blur3Fn blur3_ref;

}  // namespace darkling
