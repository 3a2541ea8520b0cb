// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// Reduces 2×2 boxes to their mean, rounded half up: one step of the pyramid. Where `src` has an odd
// size its last column or row is left out.
// @param dst  src.width / 2 by src.height / 2.
using HalveFn = void(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst);

HalveFn halve_ref;
HalveFn halve_sse41;
HalveFn halve_avx2;
HalveFn halve_neon;

}  // namespace darkling
