// SPDX-License-Identifier: Apache-2.0
#include "vo/area_map.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "vo/limits.h"

namespace darkling {

namespace {

// Fills `weights` (one phase) with the overlap of the box [phase, phase + box] and each source
// pixel [i, i + 1], in 1/256, summing to 256: what rounding leaves goes to the largest, but never
// more than a byte holds.
void fill_weights(double phase_px, double box_px, int taps, std::span<std::uint8_t> weights) {
  int shares[kMaxAreaTaps] = {};
  int left_over = 256;
  int largest = 0;
  for (int i = 0; i < taps; ++i) {
    const double overlap = std::min(i + 1.0, phase_px + box_px) - std::max<double>(i, phase_px);
    const double share = std::max(overlap, 0.0) / box_px;
    shares[i] = static_cast<int>(std::lround(256.0 * share));
    left_over -= shares[i];
    if (shares[i] > shares[largest]) largest = i;
  }
  shares[largest] += left_over;
  if (shares[largest] > 255) {
    shares[largest] = 255;
    ++shares[largest + 1 < taps ? largest + 1 : largest - 1];
  }
  for (int i = 0; i < taps; ++i) weights[i] = static_cast<std::uint8_t>(shares[i]);
}

// Where a box of `box_px` about the pixel coordinate `centre` starts on an axis of `size` pixels:
// the pixel of its first tap, such that all taps are inside, and the phase in 1/64 px.
struct BoxStart {
  std::uint16_t pixel;
  std::uint16_t phase;
};
BoxStart box_start(double centre, const AreaMap& map, int size) {
  const double start = std::clamp(centre + 0.5 - 0.5 * map.box_px, 0.0, size - map.box_px);
  const int start_q6 = static_cast<int>(std::floor(start * kAreaPhasesPerPixel + 0.5));
  const int pixel = std::min(start_q6 / kAreaPhasesPerPixel, size - map.taps);
  const int phase = std::min(start_q6 - pixel * kAreaPhasesPerPixel, kAreaPhases - 1);
  return {static_cast<std::uint16_t>(pixel), static_cast<std::uint16_t>(phase)};
}

// Mean of the local scales of the map, raw pixels a thumbnail pixel, over a grid.
double mean_scale(const Camera& camera, const RectifiedRig& rectified,
                  const Matrix3& R_raw_rectified) {
  constexpr int kGrid = 9;
  double sum = 0.0;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const double u = (i + 0.5) * rectified.width / kGrid - 0.5;
      const double v = (j + 0.5) * rectified.height / kGrid - 0.5;
      const Vector3 ray((u - rectified.cx) / rectified.focal_px,
                        (v - rectified.cy) / rectified.focal_px, 1.0);
      Eigen::Matrix<double, 2, 3> J;
      (void)project(camera, R_raw_rectified * ray, J);
      const Eigen::Matrix2d J_uv = (J * R_raw_rectified).leftCols<2>() / rectified.focal_px;
      sum += std::sqrt(std::abs(J_uv.determinant()));
    }
  }
  return sum / (kGrid * kGrid);
}

}  // namespace

AreaMapMemory allocate_area_map(const RectifiedRig& rectified, Arena& arena) {
  AreaMapMemory memory;
  memory.weights =
      arena.allocate<std::uint8_t>(std::size_t{kAreaPhases} * kMaxAreaTaps, "area weights");
  memory.entries =
      arena.allocate_image<AreaMapEntry>(rectified.width, rectified.height, "area map");
  return memory;
}

Result<AreaMap> fill_area_map(const Camera& camera, const RectifiedRig& rectified,
                              const Matrix3& R_raw_rectified, const AreaMapMemory& memory) {
  AreaMap map;
  map.box_px = std::max(1.0, mean_scale(camera, rectified, R_raw_rectified));
  map.taps = static_cast<int>(std::ceil(map.box_px)) + 1;
  if (map.taps > kMaxAreaTaps || map.taps > std::min(camera.width, camera.height)) {
    return failure(ExitCode::kConfiguration,
                   "a reduction of " + number_text(map.box_px) + " from " +
                       std::to_string(camera.width) + " to " + std::to_string(rectified.width) +
                       " px is above kMaxReduction = " + std::to_string(kMaxReduction));
  }
  for (int phase = 0; phase < kAreaPhases; ++phase) {
    fill_weights(static_cast<double>(phase) / kAreaPhasesPerPixel, map.box_px, map.taps,
                 memory.weights.subspan(std::size_t(phase) * kMaxAreaTaps, kMaxAreaTaps));
  }
  for (int v = 0; v < rectified.height; ++v) {
    for (int u = 0; u < rectified.width; ++u) {
      const Vector3 ray((u - rectified.cx) / rectified.focal_px,
                        (v - rectified.cy) / rectified.focal_px, 1.0);
      const Eigen::Vector2d raw = project(camera, R_raw_rectified * ray);
      const BoxStart x = box_start(raw.x(), map, camera.width);
      const BoxStart y = box_start(raw.y(), map, camera.height);
      memory.entries.at(u, v) = {x.pixel, y.pixel, x.phase, y.phase};
    }
  }
  map.weights = memory.weights.data();
  map.entries = memory.entries;
  return map;
}

}  // namespace darkling
