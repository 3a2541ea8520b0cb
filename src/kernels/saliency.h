// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// How much a pixel can tell about motion: the absolute central differences of all eight planes,
//   dst(x, y) = Σ_c |φ_c(x+1, y) - φ_c(x-1, y)| + |φ_c(x, y+1) - φ_c(x, y-1)|,
// 0 on the border of one pixel, at most 4080.
//
// @param planes  interleaved bit-planes, 8 · w × h bytes (kernels/bit_planes.h).
// @param dst     w × h.
// Exactness: integer; every variant equals the reference bit for bit.
using SaliencyFn = void(ImageView<const std::uint8_t> planes, ImageView<std::uint16_t> dst);

SaliencyFn saliency_ref;
SaliencyFn saliency_sse41;
SaliencyFn saliency_avx2;
SaliencyFn saliency_neon;

}  // namespace darkling
