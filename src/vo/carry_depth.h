// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "vo/frame_pyramid.h"
#include "vo/keyframe_template.h"
#include "vo/window.h"

namespace darkling {

// Scratch: for each pixel of level 0 the window's point that appears there, by its number plus one.
using PointImage = ImageView<std::uint16_t>;
[[nodiscard]] PointImage allocate_point_image(const RectifiedRig& rig, Arena& arena);

// Gives a new keyframe's points what is known of their depths from the keyframes before it: where a
// point of the window appears beside one of the new points, and its depth agrees with what stereo
// measured there, both are fused by their variances. Where they do not agree stereo is kept: it has
// seen the point itself. Points of the window that disagree with their own images as often as not
// are left out.
// @param measured  the candidates that `points` were made of, with their variances.
// @return how many points were fused.
int carry_depths(const Window& window, const Se3& T_world_key, const PyramidLevel& level,
                 std::span<const PointSelector::Candidate> measured, const PointImage& scratch,
                 TemplatePoints& points);

}  // namespace darkling
