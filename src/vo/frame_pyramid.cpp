// SPDX-License-Identifier: Apache-2.0
#include "vo/frame_pyramid.h"

#include <algorithm>
#include <cmath>

#include "geometry/frames.h"
#include "kernels/bit_planes.h"

namespace darkling {

namespace {

// The coarsest image still needs a few rows for its points to lie in.
constexpr int kMinLevelHeight = 10;

ImageView<std::uint8_t> crop(ImageView<std::uint8_t> image, const ImageView<std::uint8_t>& like) {
  return {image.data, like.width, like.height, image.stride};
}

}  // namespace

int pyramid_level_count(int width_px, int height_px) {
  const double halvings = std::log2(static_cast<double>(width_px) / kCoarsestWidth);
  int count = 1 + std::max(0, static_cast<int>(std::lround(halvings)));
  while (count > 1 && (height_px >> (count - 1)) < kMinLevelHeight) --count;
  return std::min(count, kMaxLevels);
}

FramePyramid allocate_pyramid(const RectifiedRig& rig, int level_count, Arena& arena) {
  FramePyramid pyramid;
  double focal_px = rig.focal_px;
  double cx = rig.cx;
  double cy = rig.cy;
  for (int l = 0; l < level_count; ++l) {
    const int width = rig.width >> l;
    const int height = rig.height >> l;
    PyramidLevel level;
    level.grey = arena.allocate_image<std::uint8_t>(width, height, "pyramid grey");
    level.planes = arena.allocate_image<std::uint8_t>(width * kPlaneCount, height, "bit-planes");
    level.focal_px = focal_px;
    level.cx = cx;
    level.cy = cy;
    CHECK(pyramid.push_back(level), "more levels than kMaxLevels");
    focal_px *= 0.5;
    cx = reduce_pixel(cx, 2.0);
    cy = reduce_pixel(cy, 2.0);
  }
  return pyramid;
}

PlaneScratch allocate_plane_scratch(const RectifiedRig& rig, Arena& arena) {
  PlaneScratch scratch;
  scratch.blurred = arena.allocate_image<std::uint8_t>(rig.width, rig.height, "blurred grey");
  scratch.codes = arena.allocate_image<std::uint8_t>(rig.width, rig.height, "census codes");
  const int row_pixels = rig.width + 2 * SmoothingTaps::kMaxRadius;
  scratch.row = arena.allocate<std::uint8_t>(std::size_t{kPlaneCount} * row_pixels, "plane row");
  return scratch;
}

void build_pyramid(const KernelTable& kernels, FramePyramid& pyramid) {
  for (int l = 1; l < static_cast<int>(pyramid.size()); ++l) {
    kernels.halve(pyramid[l - 1].grey, pyramid[l].grey);
  }
}

void compute_planes(const KernelTable& kernels, const SmoothingTaps& taps,
                    const PlaneScratch& scratch, PyramidLevel& level) {
  const ImageView<std::uint8_t> blurred = crop(scratch.blurred, level.grey);
  const ImageView<std::uint8_t> codes = codes_of(scratch, level);
  kernels.blur3(level.grey, blurred);
  kernels.census(blurred, codes);
  kernels.bit_planes(codes, taps, scratch.row.data(), level.planes);
}

ImageView<std::uint8_t> codes_of(const PlaneScratch& scratch, const PyramidLevel& level) {
  return crop(scratch.codes, level.grey);
}

}  // namespace darkling
