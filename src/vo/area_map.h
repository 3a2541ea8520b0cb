// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/arena.h"
#include "base/result.h"
#include "geometry/stereo_rig.h"
#include "kernels/remap_area.h"

namespace darkling {

// Prepares the rectification and reduction of one eye: where each thumbnail pixel's ray meets the
// raw image, and how large a box of raw pixels it stands for (the ratio of the local scales,
// averaged over the image, at least one pixel: then it is plain bilinear interpolation).
// @param R_raw_rectified  ray of the rectified camera → ray of the raw one.
// @return kConfiguration when the reduction is stronger than kMaxAreaTaps allows.
[[nodiscard]] Result<AreaMap> build_area_map(const Camera& camera, const RectifiedRig& rectified,
                                             const Matrix3& R_raw_rectified, Arena& arena);

}  // namespace darkling
