// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/arena.h"
#include "base/result.h"
#include "geometry/stereo_rig.h"
#include "kernels/remap_area.h"

namespace darkling {

// Memory of one eye's map.
struct AreaMapMemory {
  ImageView<AreaMapEntry> entries;
  std::span<std::uint8_t> weights;
};
[[nodiscard]] AreaMapMemory allocate_area_map(const RectifiedRig& rectified, Arena& arena);

// Prepares the rectification and reduction of one eye: where each thumbnail pixel's ray meets the
// raw image, and how large a box of raw pixels it stands for (the ratio of the local scales,
// averaged over the image, at least one pixel: then it is plain bilinear interpolation).
// @param R_raw_rectified  ray of the rectified camera → ray of the raw one.
// @return a map that looks into `memory`; kConfiguration when the reduction is stronger than
// kMaxAreaTaps allows.
[[nodiscard]] Result<AreaMap> fill_area_map(const Camera& camera, const RectifiedRig& rectified,
                                            const Matrix3& R_raw_rectified,
                                            const AreaMapMemory& memory);

}  // namespace darkling
