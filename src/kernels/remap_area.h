// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// Where the box of one output pixel begins in the source: the pixel of its first tap, and how far
// into that pixel the box starts, in 1/64 px. At the far border the first tap is moved back so that
// all taps stay inside the image; so the phase covers two pixels, not one.
struct AreaMapEntry {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  std::uint16_t phase_x = 0;
  std::uint16_t phase_y = 0;
};

inline constexpr int kAreaPhasesPerPixel = 64;
inline constexpr int kAreaPhases = 2 * kAreaPhasesPerPixel;
inline constexpr int kMaxAreaTaps = 32;  // so reductions up to 1 : 31

// One rectification and reduction, prepared: every output pixel is the mean of a square of
// `box_px` × `box_px` source pixels somewhere in the source.
struct AreaMap {
  ImageView<const AreaMapEntry> entries;  // one an output pixel
  // weights[phase * kMaxAreaTaps + tap]: the share of the box over each source pixel, in 1/256;
  // every phase sums to 256, and beyond `taps` it is 0. Used along x and along y. Where one pixel
  // has all the weight, 1/256 of it goes to a neighbour so that a byte can hold it: a grey level at
  // most in each of the two directions, and only beside edges of half the range.
  const std::uint8_t* weights = nullptr;
  int taps = 0;
  double box_px = 0.0;
};

// Rectifies and reduces in one step, without aliasing: dst(u, v) = Σ_j Σ_i w_i w_j src(x + i, y +
// j) over the source pixels under the output pixel's box.
//
// @param src  as captured; every entry of the map lies inside with all its taps.
// @param dst  the size of the map.
// Exactness: rounds once, at the end; every variant equals the reference bit for bit.
// Cost: taps² multiply-adds and 8 bytes of map an output pixel.
using RemapAreaFn = void(const AreaMap& map, ImageView<const std::uint8_t> src,
                         ImageView<std::uint8_t> dst);

RemapAreaFn remap_area_ref;
RemapAreaFn remap_area_sse41;
RemapAreaFn remap_area_avx2;
RemapAreaFn remap_area_neon;

}  // namespace darkling
