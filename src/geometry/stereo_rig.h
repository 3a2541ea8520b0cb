// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/result.h"
#include "geometry/camera.h"
#include "geometry/se3.h"

namespace darkling {

// Two cameras on one body, as calibrated.
struct StereoRig {
  Camera left;
  Camera right;
  Se3 T_body_rawleft;
  Se3 T_body_rawright;
};

// A rectified pair of ideal pinhole cameras that share `focal_px`, `cx`, `cy` and look along the
// same axis: a point at (u, v) in the left has v the same in the right and u - disparity.
struct RectifiedRig {
  int width = 0;   // px, of the thumbnail
  int height = 0;  // px
  double focal_px = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  double baseline_m = 0.0;
  Se3 T_body_left;                               // rectified left optical frame
  Matrix3 R_rawleft_left = Matrix3::Identity();  // rectified ray → ray of the raw camera
  Matrix3 R_rawright_right = Matrix3::Identity();
};

// Refuses rigs that cannot be right: numbers that are not finite, sizes that differ or are absurd,
// focal lengths or principal points far outside the image, a baseline that is zero, negative (right
// camera on the left: the eyes are swapped), under 5 mm, over 5 m or more than 30° off the image
// rows (upright pairs too), cameras turned more than 30° against each other.
// @return kConfiguration with what was found and what is allowed.
[[nodiscard]] Result<void> check_rig(const StereoRig& rig);

// Of a thumbnail that keeps the aspect ratio of `source`, px.
[[nodiscard]] int thumbnail_height(const Camera& source, int width_px);

// Chooses the rectified pair: optical axes turned the least that makes rows match, field of view
// the largest whose every pixel is seen by both cameras (at most 100° across). A pair that is
// rectified already keeps its geometry, scaled; as heights are rounded to whole pixels, its last
// row may then reach up to half a thumbnail pixel beyond the source.
// @param width_px  thumbnail width; 0 means the source's. Height keeps the source's aspect ratio.
// @return kConfiguration when check_rig() refuses, the width is not 32…source, or the common field
// of view is under 10°.
// Cost: some 15 ms; at start only.
[[nodiscard]] Result<RectifiedRig> rectify_rig(const StereoRig& rig, int width_px);

}  // namespace darkling
