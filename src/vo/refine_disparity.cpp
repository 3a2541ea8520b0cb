// SPDX-License-Identifier: Apache-2.0
#include "vo/refine_disparity.h"

#include <algorithm>
#include <cmath>

#include "vo/match_stereo.h"

namespace darkling {

namespace {

// Smoothing has already spread every bit over some 3 px; patches of 5 and 7 px only add surfaces
// that slant away (1.16 and 1.31 % drift in place of 1.11 % on a car's road, steps of 3.6 m 1.59 %
// in place of 1.39 %).
constexpr int kPatchRadius = 1;
constexpr int kMaxIterations = 5;
constexpr float kConvergedStepPx = 0.005f;
// The matched pixel is right or it is not: refinement that leaves it found something else.
constexpr float kMaxChangePx = 1.0f;
// Root mean square difference over the patch's planes beyond which the eyes do not see the same; as
// for whole points, unrelated patches are about 110 apart. Without it a covered right eye gave a
// keyframe, and valid motions nine times too long.
constexpr float kMaxDistance = 80.0f;
constexpr int kPatchValues = (2 * kPatchRadius + 1) * (2 * kPatchRadius + 1) * kPlaneCount;

struct PatchFit {
  float gr = 0.0f;  // Σ g · r
  float gg = 0.0f;  // Σ g²
  float rr = 0.0f;  // Σ r²
};

// Compares the patch about the left pixel with the right one at disparity d, along the rows.
PatchFit compare_patch(const PyramidLevel& left, const PyramidLevel& right, int x, int y, float d) {
  PatchFit fit;
  const float start = static_cast<float>(x - kPatchRadius) - d;
  const int u0 = static_cast<int>(std::floor(start));
  const float du = start - static_cast<float>(u0);
  for (int j = -kPatchRadius; j <= kPatchRadius; ++j) {
    const std::uint8_t* l = left.planes.row(y + j) + (x - kPatchRadius) * kPlaneCount;
    const std::uint8_t* r = right.planes.row(y + j) + u0 * kPlaneCount;
    for (int i = 0; i < (2 * kPatchRadius + 1) * kPlaneCount; ++i) {
      const float value =
          static_cast<float>(r[i]) + du * static_cast<float>(r[i + kPlaneCount] - r[i]);
      const float g = 0.5f * static_cast<float>(l[i + kPlaneCount] - l[i - kPlaneCount]);
      const float residual = value - static_cast<float>(l[i]);
      fit.gr += g * residual;
      fit.gg += g * g;
      fit.rr += residual * residual;
    }
  }
  return fit;
}

float refine(const PyramidLevel& left, const PyramidLevel& right, int x, int y, float d0) {
  const int width = left.grey.width;
  if (x < kPatchRadius + 1 || x >= width - kPatchRadius - 1 || y < kPatchRadius ||
      y >= left.grey.height - kPatchRadius) {
    return kNoDisparity;
  }
  float d = d0;
  float rr = 0.0f;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (static_cast<float>(x - kPatchRadius) - d < 0.0f ||
        static_cast<float>(x + kPatchRadius) - d >= static_cast<float>(width - 2)) {
      return kNoDisparity;
    }
    const PatchFit fit = compare_patch(left, right, x, y, d);
    if (fit.gg <= 0.0f) return kNoDisparity;
    rr = fit.rr;
    const float step = fit.gr / fit.gg;
    d += step;
    if (std::abs(d - d0) > kMaxChangePx) return kNoDisparity;
    if (std::abs(step) < kConvergedStepPx) break;
  }
  if (rr > kMaxDistance * kMaxDistance * kPatchValues) return kNoDisparity;
  return std::max(d, 0.0f);
}

}  // namespace

void refine_disparities(const PyramidLevel& left, const PyramidLevel& right,
                        std::span<PointSelector::Candidate> candidates) {
  for (PointSelector::Candidate& candidate : candidates) {
    candidate.disparity_px = refine(left, right, candidate.x, candidate.y, candidate.disparity_px);
  }
}

std::span<PointSelector::Candidate> drop_unknown(std::span<PointSelector::Candidate> candidates) {
  const auto end =
      std::remove_if(candidates.begin(), candidates.end(),
                     [](const PointSelector::Candidate& c) { return c.disparity_px < 0.0f; });
  return candidates.first(static_cast<std::size_t>(end - candidates.begin()));
}

}  // namespace darkling
