// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// The 3×3 census transform: one bit a neighbour, one byte a pixel.
//
//   code(x, y) bit c = 1  iff  src(neighbour c of (x, y)) > src(x, y)
//
// Neighbours are numbered in raster order: 0 1 2 / 3 · 4 / 5 6 7. Beyond the border the nearest
// pixel of the image stands in (replication).
//
// @param src   grey levels, at least 1×1.
// @param dst   same size; any stride; may not overlap `src`.
// Exactness: every variant equals the reference bit for bit.
// Cost: one read and one write a pixel; eight comparisons.
// Source: Zabih, Woodfill, "Non-parametric local transforms for computing visual correspondence",
// ECCV 1994, with the strict comparison of Alismail et al. 2016.
using CensusFn = void(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst);

CensusFn census_ref;
CensusFn census_sse41;
CensusFn census_avx2;
CensusFn census_neon;

}  // namespace darkling
