// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/arena.h"
#include "base/fixed_vector.h"
#include "geometry/stereo_rig.h"
#include "kernels/kernel_table.h"
#include "vo/limits.h"

namespace darkling {

// One reduction of one eye's image. Level 0 is the thumbnail; each further one halves it.
struct PyramidLevel {
  ImageView<std::uint8_t> grey;
  ImageView<std::uint8_t> planes;  // interleaved bit-planes, 8 bytes a pixel
  double focal_px = 0.0;
  double cx = 0.0;  // px; halving a coordinate maps c to (c + 0.5) / 2 - 0.5
  double cy = 0.0;
};

// Scratch that every level and both eyes share, sized for level 0.
struct PlaneScratch {
  ImageView<std::uint8_t> blurred;
  ImageView<std::uint8_t> codes;
  std::span<std::uint8_t> row;
};

using FramePyramid = FixedVector<PyramidLevel, kMaxLevels>;

// How many levels a thumbnail of this width gets: see kCoarsestWidth.
[[nodiscard]] int pyramid_level_count(int width_px, int height_px);

// @param level_count  1 for the right eye, which is only matched, never tracked.
[[nodiscard]] FramePyramid allocate_pyramid(const RectifiedRig& rig, int level_count, Arena& arena);
[[nodiscard]] PlaneScratch allocate_plane_scratch(const RectifiedRig& rig, Arena& arena);

// Fills the levels above 0 from level 0's grey image.
void build_pyramid(const KernelTable& kernels, FramePyramid& pyramid);

// Fills the bit-planes of one level: blur, census, smoothed planes. `scratch.codes` keeps the
// level's census codes until the next call.
void compute_planes(const KernelTable& kernels, const SmoothingTaps& taps,
                    const PlaneScratch& scratch, PyramidLevel& level);

// The census codes of compute_planes(), as a view of the level's size.
[[nodiscard]] ImageView<std::uint8_t> codes_of(const PlaneScratch& scratch,
                                               const PyramidLevel& level);

}  // namespace darkling
