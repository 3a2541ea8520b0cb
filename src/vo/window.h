// SPDX-License-Identifier: Apache-2.0
// The last keyframes, each with some of its points: what is refined together.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/arena.h"
#include "base/fixed_vector.h"
#include "geometry/se3.h"
#include "vo/keyframe_template.h"
#include "vo/limits.h"
#include "vo/odometry_config.h"

namespace darkling {

// The left image of a later keyframe that the points of a host keyframe were compared with, as it
// was found then. The image itself is not kept: beside that place the comparison is continued by
// the gradients of the host, as in the inverse compositional step itself. The planes of five
// keyframes would take 3 MiB at 320x240; this takes 16 bytes a point.
//
// Later keyframes' right images were compared too, and are not now: with them a car's drift was
// 1.37 % at 310 px and 1.36 % at 178 px, without 1.06 and 0.99 % (a length 0.4 and 0.6 % shorter,
// as at full width), for 1 % less on rendered drives and twice the time. What holds the scale is
// each point's own stereo disparity, by its variance.
struct WindowView {
  Se3 T_later_host;            // where the points were compared, …
  float* depth = nullptr;      // … with these inverse depths: f / z, px/m
  PointResiduals residuals;    // what was found
  float inverse_scale = 0.0f;  // 1 / (8 σ²) of the robust weight
  int visible_count = 0;
};

// The cost of a comparison is e / (1 + e), e = squares / (8 σ²) of the eight planes: near its
// minimum a quarter of a negative log likelihood, whose curvature is 1 / variance; of half a
// curvature, which is what normal equations hold, an eighth.
inline constexpr float kCostOfInformation = 0.125f;

// A keyframe and those of its points that the window keeps, an array a member.
struct WindowKeyframe {
  Se3 T_world_key;
  TemplatePoints points;                // inverse_depth_focal is the present estimate
  float* stereo_depth = nullptr;        // what its own right image says: f / z, px/m
  float* stereo_information = nullptr;  // of it, in units of the cost: m²/px²
  float* information = nullptr;         // of the present estimate, all views together; same units
  float* inlier_ratio = nullptr;  // share of the comparisons that agree: Beta(1, 1) before any
  std::array<WindowView, kMaxWindowKeyframes - 1> views;  // [keyframes later - 1]
};

struct Window {
  int point_capacity = 0;  // of one keyframe
  double baseline_m = 0.0;
  double focal_px = 0.0;  // of level 0
  FixedVector<WindowKeyframe, kMaxWindowKeyframes> slots;
  int count = 0;  // slots in use, the oldest first

  [[nodiscard]] int capacity() const { return static_cast<int>(slots.size()); }
  [[nodiscard]] std::span<WindowKeyframe> keyframes() {
    return {slots.data(), static_cast<std::size_t>(count)};
  }
  [[nodiscard]] std::span<const WindowKeyframe> keyframes() const {
    return {slots.data(), static_cast<std::size_t>(count)};
  }
  [[nodiscard]] WindowKeyframe& newest() { return slots[static_cast<std::size_t>(count - 1)]; }
};

// Memory for config.window_keyframes keyframes of config.window_points points each.
// @param window  new.
void allocate_window(const RectifiedRig& rig, const OdometryConfig& config, Arena& arena,
                     Window& window);

// Appends a keyframe with points of its template, evenly taken from all of them; the oldest leaves
// when the window is full.
// @param from    of the finest level, with the depths that are thought best.
// @param stereo  the candidates they were made of: their disparities are what the own right image
//                says, and no more.
void add_keyframe(const Se3& T_world_key, const TemplatePoints& from,
                  std::span<const PointSelector::Candidate> stereo, Window& window);

}  // namespace darkling
