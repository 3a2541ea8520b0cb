// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/sample_residuals.h"

namespace darkling {

// Four times the Gram matrix of the plane gradients, exact: at most 8 · 255² each.
struct GramMatrix4 {
  std::int32_t xx = 0;
  std::int32_t xy = 0;
  std::int32_t yy = 0;
};

// What the bit-planes are about one pixel of a keyframe: their values, twice their central
// differences, and the Gram matrix of these.
// @param planes  interleaved bit-planes at the pixel; its four neighbours exist.
// Exactness: integers; every variant equals the reference.
using TakePatchFn = GramMatrix4(const std::uint8_t* planes, std::ptrdiff_t stride,
                                PlanePatch& patch);

TakePatchFn take_patch_ref;
TakePatchFn take_patch_sse41;
TakePatchFn take_patch_neon;

}  // namespace darkling
