// SPDX-License-Identifier: Apache-2.0
// What every variant of remap_area shares: the walk over the image and the pixels that no vector
// fits. Nothing here is inline, so that no code of a wider instruction set can leak out of the
// variant's own file.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/remap_area.h"

namespace darkling {

// The source image of one call.
struct RemapSource {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride;
  const std::uint8_t* weights;
  int taps;
  // Where the first eight rows of a box begin. Rows beyond `taps` have no weight but may lie
  // outside the image, so the last row stands in.
  std::ptrdiff_t rows[8];
};

// Writes the eight output pixels of eight entries. May read four columns of a box with at most four
// taps, else whole groups of eight.
using RemapEightFn = void(const RemapSource& source, const AreaMapEntry* entries,
                          std::uint8_t* out);

// Does what RemapAreaFn promises, eight pixels at a time where they may be read so.
void remap_area_by_eights(const AreaMap& map, const ImageView<const std::uint8_t>& src,
                          const ImageView<std::uint8_t>& dst, RemapEightFn* remap_eight);

}  // namespace darkling
