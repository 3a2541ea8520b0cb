// SPDX-License-Identifier: Apache-2.0
#include "vo/window.h"

#include <algorithm>

#include "geometry/stereo_rig.h"
#include "vo/align.h"
#include "vo/copy_points.h"

namespace darkling {

namespace {

// Views come after their keyframe's points in one block: an arena has names for 256 buffers only.
void allocate_keyframe(int views, int points, Arena& arena, WindowKeyframe& keyframe) {
  constexpr int kArraysOfView = 4;
  constexpr int kArraysOfKeyframe = 4;
  const std::size_t lanes = round_up_to_lanes(points);
  keyframe.points = allocate_points(points, "window points", "window patches", arena);
  const std::span<float> block = arena.allocate<float>(
      lanes * (kArraysOfKeyframe + kArraysOfView * views), "window observations");
  float* next = block.data();
  const auto array = [&] {
    float* first = next;
    if (next != nullptr) next += lanes;
    return first;
  };
  keyframe.stereo_depth = array();
  keyframe.stereo_information = array();
  keyframe.information = array();
  keyframe.inlier_ratio = array();
  for (int later = 0; later < views; ++later) {
    WindowView& view = keyframe.views[later];
    view.depth = array();
    view.residuals = {array(), array(), array()};
  }
}

}  // namespace

void allocate_window(const RectifiedRig& rig, const OdometryConfig& config, Arena& arena,
                     Window& window) {
  window.point_capacity = std::min(config.window_points, config.points_per_level);
  window.baseline_m = rig.baseline_m;
  window.focal_px = rig.focal_px;
  for (int i = 0; i < config.window_keyframes; ++i) {
    CHECK(window.slots.push_back(WindowKeyframe()), "more keyframes than kMaxWindowKeyframes");
    allocate_keyframe(config.window_keyframes - 1, window.point_capacity, arena,
                      window.slots[static_cast<std::size_t>(i)]);
  }
}

void add_keyframe(const Se3& T_world_key, const TemplatePoints& from,
                  std::span<const PointSelector::Candidate> stereo, Window& window) {
  if (window.count == window.capacity()) {
    std::rotate(window.slots.begin(), window.slots.begin() + 1, window.slots.end());
    --window.count;
  }
  ++window.count;
  WindowKeyframe& key = window.newest();
  key.T_world_key = T_world_key;
  const float b = static_cast<float>(window.baseline_m);
  TemplatePoints& to = key.points;
  copy_points(from, window.point_capacity, to);
  for (int n = 0; n < to.count; ++n) {
    const int i = spread_index(n, to.count, from.count);
    key.stereo_depth[n] = stereo[i].disparity_px / b;
    key.stereo_information[n] = kCostOfInformation * b * b / stereo[i].variance_px2;
    key.information[n] = key.stereo_information[n];
    key.inlier_ratio[n] = 0.5f;
  }
  for (WindowView& view : key.views) view.visible_count = 0;
}

}  // namespace darkling
