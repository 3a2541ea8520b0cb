// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "base/arena.h"
#include "base/fixed_vector.h"
#include "geometry/stereo_rig.h"
#include "kernels/kernel_table.h"
#include "vo/limits.h"
#include "vo/measure_image.h"

namespace darkling {

// One reduction of one eye's image. Level 0 is the thumbnail; each further one halves it.
struct PyramidLevel {
  ImageView<std::uint8_t> grey;
  ImageView<std::uint8_t> planes;  // interleaved bit-planes, 8 bytes a pixel; or empty
  ImageView<std::uint8_t> codes;   // census codes, where stereo needs them; else empty
  int dead_zone = 0;               // of the planes, from the image's noise: see measure_image.h
  double focal_px = 0.0;
  double cx = 0.0;  // px; halving a coordinate maps c to (c + 0.5) / 2 - 0.5
  double cy = 0.0;
};

using FramePyramid = FixedVector<PyramidLevel, kMaxLevels>;

// How many levels a thumbnail of this width gets: see kCoarsestWidth.
[[nodiscard]] int pyramid_level_count(int width_px, int height_px);

// What the levels of a pyramid are for.
struct PyramidLayout {
  int level_count = 0;
  int planes_level_count = 0;  // levels 0 … planes_level_count - 1 have planes
  int stereo_level = 0;        // this level and level 0 have codes
};
[[nodiscard]] FramePyramid allocate_pyramid(const RectifiedRig& rig, const PyramidLayout& layout,
                                            Arena& arena);
// Scratch that every level and both eyes share, sized for level 0.
[[nodiscard]] std::span<std::uint8_t> allocate_plane_scratch(const RectifiedRig& rig, Arena& arena);

// Fills the levels above 0 from level 0's grey image, and the dead zones of all from its noise.
// @return what level 0 says about itself.
ImageMeasure build_pyramid(const KernelTable& kernels, FramePyramid& pyramid);

// Fills the bit-planes and the census codes of one level, as far as it has them.
void compute_planes(const KernelTable& kernels, std::span<std::uint8_t> scratch,
                    PyramidLevel& level);

}  // namespace darkling
