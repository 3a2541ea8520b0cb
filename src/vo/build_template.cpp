// SPDX-License-Identifier: Apache-2.0
#include "vo/keyframe_template.h"

namespace darkling {

namespace {

TemplatePoints allocate_points(int capacity, Arena& arena) {
  const auto array = [&](const char* name) {
    return arena.allocate<float>(round_up_to_lanes(capacity), name).data();
  };
  TemplatePoints points;
  points.x = array("template x");
  points.y = array("template y");
  points.inverse_depth_focal = array("template inverse depths");
  points.Sxx = array("template Sxx");
  points.Sxy = array("template Sxy");
  points.Syy = array("template Syy");
  points.patches =
      arena.allocate<PlanePatch>(round_up_to_lanes(capacity), "template patches").data();
  return points;
}

// The planes about one pixel, and point `i`'s Gram matrix of their gradients.
void take_patch(const ImageView<const std::uint8_t>& planes, int x, int y, int i,
                TemplatePoints& points) {
  const std::uint8_t* here = planes.row(y) + x * kPlaneCount;
  const std::uint8_t* above = here - planes.stride;
  const std::uint8_t* below = here + planes.stride;
  PlanePatch& patch = points.patches[i];
  int Sxx4 = 0;  // four times S, exact: at most 8 · 510²
  int Sxy4 = 0;
  int Syy4 = 0;
  for (int c = 0; c < kPlaneCount; ++c) {
    const int gx2 = here[c + kPlaneCount] - here[c - kPlaneCount];
    const int gy2 = below[c] - above[c];
    patch.reference[c] = here[c];
    patch.gx2[c] = static_cast<std::int16_t>(gx2);
    patch.gy2[c] = static_cast<std::int16_t>(gy2);
    Sxx4 += gx2 * gx2;
    Sxy4 += gx2 * gy2;
    Syy4 += gy2 * gy2;
  }
  points.Sxx[i] = 0.25f * static_cast<float>(Sxx4);
  points.Sxy[i] = 0.25f * static_cast<float>(Sxy4);
  points.Syy[i] = 0.25f * static_cast<float>(Syy4);
}

}  // namespace

KeyframeTemplate allocate_template(int level_count, int points_per_level, Arena& arena) {
  KeyframeTemplate keyframe;
  for (int l = 0; l < level_count; ++l) {
    const TemplateLevel level = {allocate_points(points_per_level, arena), points_per_level, 0.0f};
    CHECK(keyframe.levels.push_back(level), "more levels than kMaxLevels");
  }
  return keyframe;
}

void build_template_level(std::span<const PointSelector::Candidate> candidates,
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
    take_patch(level.planes, candidate.x, candidate.y, i, points);
    inverse_depth_sum += static_cast<double>(points.inverse_depth_focal[i]);
  }
  points.count = count;
  out.mean_inverse_depth_focal = count > 0 ? static_cast<float>(inverse_depth_sum / count) : 0.0f;
}

}  // namespace darkling
