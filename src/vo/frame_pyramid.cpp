// SPDX-License-Identifier: Apache-2.0
#include "vo/frame_pyramid.h"

#include <algorithm>
#include <cmath>

#include "geometry/frames.h"
#include "kernels/bit_planes.h"
#include "vo/measure_image.h"

namespace darkling {

namespace {

// The coarsest image still needs a few rows for its points to lie in.
constexpr int kMinLevelHeight = 10;

}  // namespace

int pyramid_level_count(int width_px, int height_px) {
  const double halvings = std::log2(static_cast<double>(width_px) / kCoarsestWidth);
  int count = 1 + std::max(0, static_cast<int>(std::lround(halvings)));
  while (count > 1 && (height_px >> (count - 1)) < kMinLevelHeight) --count;
  return std::min(count, kMaxLevels);
}

FramePyramid allocate_pyramid(const RectifiedRig& rig, const PyramidLayout& layout, Arena& arena) {
  FramePyramid pyramid;
  double focal_px = rig.focal_px;
  double cx = rig.cx;
  double cy = rig.cy;
  for (int l = 0; l < layout.level_count; ++l) {
    const int width = rig.width >> l;
    const int height = rig.height >> l;
    PyramidLevel level;
    level.grey = arena.allocate_image<std::uint8_t>(width, height, "pyramid grey");
    if (l < layout.planes_level_count) {
      level.planes = arena.allocate_image<std::uint8_t>(width * kPlaneCount, height, "bit-planes");
    }
    if (l == 0 || l == layout.stereo_level) {
      level.codes = arena.allocate_image<std::uint8_t>(width, height, "census codes");
    }
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

std::span<std::uint8_t> allocate_plane_scratch(const RectifiedRig& rig, Arena& arena) {
  return arena.allocate<std::uint8_t>(bit_planes_scratch_bytes(rig.width), "plane rows");
}

ImageMeasure build_pyramid(const KernelTable& kernels, FramePyramid& pyramid) {
  const ImageMeasure measure = measure_image(pyramid[0].grey);
  double noise = measure.noise;
  pyramid[0].dead_zone = dead_zone_of(noise);
  for (int l = 1; l < static_cast<int>(pyramid.size()); ++l) {
    kernels.halve(pyramid[l - 1].grey, pyramid[l].grey);
    noise *= 0.5;  // four pixels of independent noise in one
    pyramid[l].dead_zone = dead_zone_of(noise);
  }
  return measure;
}

void compute_planes(const KernelTable& kernels, std::span<std::uint8_t> scratch,
                    PyramidLevel& level) {
  if (level.planes.is_empty() && level.codes.is_empty()) return;
  kernels.bit_planes(level.grey, level.dead_zone, level.codes, scratch, level.planes);
}

}  // namespace darkling
