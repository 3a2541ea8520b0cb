// SPDX-License-Identifier: Apache-2.0
#include "vo/keyframe_template.h"

namespace darkling {

TemplatePoints allocate_points(int capacity, const char* points_name, const char* patches_name,
                               Arena& arena) {
  const auto array = [&] {
    return arena.allocate<float>(round_up_to_lanes(capacity), points_name).data();
  };
  TemplatePoints points;
  points.x = array();
  points.y = array();
  points.inverse_depth_focal = array();
  points.Sxx = array();
  points.Sxy = array();
  points.Syy = array();
  points.patches = arena.allocate<PlanePatch>(round_up_to_lanes(capacity), patches_name).data();
  return points;
}

KeyframeTemplate allocate_template(int level_count, int points_per_level, Arena& arena) {
  KeyframeTemplate keyframe;
  for (int l = 0; l < level_count; ++l) {
    const int capacity = points_on_level(points_per_level, l);
    const TemplateLevel level = {
        allocate_points(capacity, "template points", "template patches", arena), capacity, 0.0f};
    CHECK(keyframe.levels.push_back(level), "more levels than kMaxLevels");
  }
  return keyframe;
}

void build_template_level(const KernelTable& kernels,
                          std::span<const PointSelector::Candidate> candidates,
                          const PyramidLevel& level, double baseline_m, TemplateLevel& out) {
  const int count = static_cast<int>(candidates.size());
  CHECK(count <= out.capacity, "more candidates than template points");
  TemplatePoints& points = out.points;
  double inverse_depth_sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const PointSelector::Candidate& candidate = candidates[i];
    points.x[i] = static_cast<float>(candidate.x - level.cx);
    points.y[i] = static_cast<float>(candidate.y - level.cy);
    points.inverse_depth_focal[i] = static_cast<float>(candidate.disparity_px / baseline_m);
    const GramMatrix4 S4 =
        kernels.take_patch(level.planes.row(candidate.y) + candidate.x * kPlaneCount,
                           level.planes.stride, points.patches[i]);
    points.Sxx[i] = 0.25f * static_cast<float>(S4.xx);
    points.Sxy[i] = 0.25f * static_cast<float>(S4.xy);
    points.Syy[i] = 0.25f * static_cast<float>(S4.yy);
    inverse_depth_sum += static_cast<double>(points.inverse_depth_focal[i]);
  }
  points.count = count;
  out.mean_inverse_depth_focal = count > 0 ? static_cast<float>(inverse_depth_sum / count) : 0.0f;
}

}  // namespace darkling
