// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/image_view.h"

namespace darkling {

// Eight planes an image, one a census neighbour, interleaved: the eight values of a pixel are
// neighbouring bytes, so one 16-byte load holds two pixels and sampling all planes bilinearly is
// two loads. A view of planes is an image of bytes, 8 · width wide.
inline constexpr int kPlaneCount = 8;

// Grey levels to smoothed bit-planes in one pass over rows that stay in cache:
//
//   1. blur      B = [1 2 1]ᵀ[1 2 1] · grey / 16, rounded half up, a Gaussian of σ = 0.71 px: what
//                takes the pixel noise off before neighbours are compared. To compare sums that are
//                not rounded was tried: ties are then decided by noise, and the RPE of rendered
//                drives rises by 5 to 16 %;
//   2. census    of the neighbours in raster order 0 1 2 / 3 · 4 / 5 6 7 (3×3 census transform),
//                  bit c of brighter(x, y) = 1  iff  B(neighbour c) - B(x, y) > dead zone,
//                  bit c of darker(x, y)   = 1  iff  B(neighbour c) - B(x, y) <= -dead zone;
//   3. planes    plane c becomes 255 where the neighbour is brighter, 0 where it is darker and 128
//                where neither can be said: differences that noise makes up are no bits. Without a
//                dead zone nothing is left undecided. To leave ties undecided too was tried: the
//                RPE of rendered drives rises by a tenth to a fifth;
//   4. smoothing three times down the columns, then three times along the rows,
//                  m(i) ← ⌈(⌈(m(i-1) + m(i+1)) / 2⌉ + m(i)) / 2⌉:
//                in all the binomial filter of order 6, a Gaussian of σ = 1.22 px. Each half step
//                is one byte-wise rounded average, an instruction everywhere; the roundings shift a
//                plane by at most 3 of 255, the same in every image.
//
// Beyond the border the nearest pixel stands in, before each of the four steps.
//
// @param grey     at least 1×1.
// @param dead_zone  grey levels, 0…255: differences of B no larger than this say nothing.
// @param codes    the codes of what is brighter, same size; or empty, when nobody asks for them.
// @param scratch  bit_planes_scratch_bytes(width), aligned to 64 bytes.
// @param planes   8 · w × h bytes; or empty, when only the codes are asked for.
// @pre none of the images overlap.
// Exactness: every variant equals the reference bit for bit.
// Cost: a read and eight writes a pixel; the rest stays in the scratch rows (69 bytes a column).
// Source: Zabih, Woodfill, "Non-parametric local transforms for computing visual correspondence",
// ECCV 1994; Alismail, Browning, Lucey, "Robust tracking in low light and sudden illumination
// changes", 3DV 2016.
using BitPlanesFn = void(ImageView<const std::uint8_t> grey, int dead_zone,
                         ImageView<std::uint8_t> codes, std::span<std::uint8_t> scratch,
                         ImageView<std::uint8_t> planes);

BitPlanesFn bit_planes_ref;
BitPlanesFn bit_planes_sse41;
BitPlanesFn bit_planes_avx2;
BitPlanesFn bit_planes_neon;

// Rows of the scratch are this many bytes longer than the image on either side, so that
// neighbours exist and the last vector of a row may run over.
inline constexpr int kPlanesMargin = 64;

constexpr std::size_t bit_planes_scratch_bytes(int width) {
  const std::size_t pixels = (static_cast<std::size_t>(width) + 63) / 64 * 64;
  const std::size_t grey_row = pixels + 2 * kPlanesMargin;
  const std::size_t plane_row = kPlaneCount * pixels + 2 * kPlanesMargin;
  return 5 * grey_row + 8 * plane_row;  // three of the blurred image, two of codes
}

}  // namespace darkling
