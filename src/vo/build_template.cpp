// SPDX-License-Identifier: Apache-2.0
#include "vo/keyframe_template.h"

namespace darkling {

KeyframeTemplate allocate_template(int level_count, int points_per_level, Arena& arena) {
  KeyframeTemplate keyframe;
  for (int l = 0; l < level_count; ++l) {
    TemplateLevel level;
    level.storage = arena.allocate<TemplatePoint>(points_per_level, "template points");
    CHECK(keyframe.levels.push_back(level), "more levels than kMaxLevels");
  }
  return keyframe;
}

void build_template_level(std::span<const PointSelector::Candidate> candidates,
                          const PyramidLevel& level, double baseline_m, TemplateLevel& out) {
  CHECK(candidates.size() <= out.storage.size(), "more candidates than template points");
  double inverse_depth_sum = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const PointSelector::Candidate& candidate = candidates[i];
    const std::uint8_t* here = level.planes.row(candidate.y) + candidate.x * kPlaneCount;
    const std::uint8_t* above = here - level.planes.stride;
    const std::uint8_t* below = here + level.planes.stride;
    TemplatePoint& point = out.storage[i];
    point.x = static_cast<float>(candidate.x - level.cx);
    point.y = static_cast<float>(candidate.y - level.cy);
    point.inverse_depth_focal = static_cast<float>(candidate.disparity_px / baseline_m);
    int Sxx4 = 0;  // four times S, exact: at most 8 · 510²
    int Sxy4 = 0;
    int Syy4 = 0;
    for (int c = 0; c < kPlaneCount; ++c) {
      const int gx2 = here[c + kPlaneCount] - here[c - kPlaneCount];
      const int gy2 = below[c] - above[c];
      point.reference[c] = here[c];
      point.gx2[c] = static_cast<std::int16_t>(gx2);
      point.gy2[c] = static_cast<std::int16_t>(gy2);
      Sxx4 += gx2 * gx2;
      Sxy4 += gx2 * gy2;
      Syy4 += gy2 * gy2;
    }
    point.Sxx = 0.25f * static_cast<float>(Sxx4);
    point.Sxy = 0.25f * static_cast<float>(Sxy4);
    point.Syy = 0.25f * static_cast<float>(Syy4);
    inverse_depth_sum += static_cast<double>(point.inverse_depth_focal);
  }
  out.count = static_cast<int>(candidates.size());
  out.mean_inverse_depth_focal =
      out.count > 0 ? static_cast<float>(inverse_depth_sum / out.count) : 0.0f;
}

}  // namespace darkling
