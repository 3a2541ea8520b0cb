// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "vo/keyframe_template.h"
#include "vo/match_stereo.h"

namespace darkling {

namespace {

// Gradients reach one pixel further and bilinear sampling two.
constexpr int kBorder = 2;
// Σ|∂φ| below which a pixel is flat: an edge of the planes is worth about 255 a plane it is in.
constexpr std::uint16_t kMinSaliency = 64;

// The disparity of a pixel `level` levels above that of `disparity`, in its own pixels: the median
// of what is known in the block that the pixel was reduced from. Below that level (`level` < 0) it
// is that of the coarser pixel that it became part of.
float block_disparity(ImageView<const float> disparity, int level, int x, int y) {
  if (level <= 0) {
    const int u = std::min(x >> -level, disparity.width - 1);
    const int v = std::min(y >> -level, disparity.height - 1);
    return disparity.at(u, v) * static_cast<float>(1 << -level);
  }
  const int size = 1 << level;
  constexpr int kMaxSamples = 64;  // of larger blocks an even subset
  const int step = std::max(1, size / 8);
  float known[kMaxSamples];
  int count = 0;
  for (int j = 0; j < size; j += step) {
    for (int i = 0; i < size; i += step) {
      const int u = std::min(x * size + i, disparity.width - 1);
      const int v = std::min(y * size + j, disparity.height - 1);
      const float d = disparity.at(u, v);
      if (d >= 0.0f && count < kMaxSamples) known[count++] = d;
    }
  }
  if (count == 0) return kNoDisparity;
  std::nth_element(known, known + count / 2, known + count);
  return known[count / 2] / static_cast<float>(size);
}

// A rectangle of pixels, ends excluded.
struct Cell {
  int x_begin;
  int x_end;
  int y_begin;
  int y_end;
};

// The most salient pixel of a cell whose disparity is known; kNoDisparity when there is none.
PointSelector::Candidate best_in_cell(const Cell& cell, ImageView<const std::uint16_t> saliency,
                                      ImageView<const float> disparity, int level) {
  PointSelector::Candidate best = {0, 0, kMinSaliency, kNoDisparity};
  for (int y = cell.y_begin; y < cell.y_end; ++y) {
    for (int x = cell.x_begin; x < cell.x_end; ++x) {
      if (saliency.at(x, y) <= best.saliency) continue;
      const float d = block_disparity(disparity, level, x, y);
      if (d < 0.0f) continue;
      best = {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), saliency.at(x, y), d};
    }
  }
  return best;
}

}  // namespace

PointSelector allocate_point_selector(const RectifiedRig& rig, int points_per_level, Arena& arena) {
  PointSelector selector;
  selector.saliency = arena.allocate_image<std::uint16_t>(rig.width, rig.height, "saliency");
  selector.candidates =
      arena.allocate<PointSelector::Candidate>(points_per_level, "point candidates");
  return selector;
}

std::span<PointSelector::Candidate> select_points(const KernelTable& kernels,
                                                  const PyramidLevel& planes, int level,
                                                  ImageView<const float> disparity,
                                                  int disparity_level,
                                                  const PointSelector& selector) {
  const int width = planes.grey.width;
  const int height = planes.grey.height;
  const ImageView<std::uint16_t> saliency{selector.saliency.data, width, height,
                                          selector.saliency.stride};
  kernels.saliency(planes.planes, saliency);

  const int wanted = static_cast<int>(selector.candidates.size());
  const double cell_px = std::max(1.0, std::sqrt(double(width) * height / wanted));
  const int columns = static_cast<int>(width / cell_px);
  const int rows = static_cast<int>(height / cell_px);
  std::size_t count = 0;
  for (int row = 0; row < rows; ++row) {
    const int y_begin = std::max(kBorder, row * height / rows);
    const int y_end = std::min(height - kBorder, (row + 1) * height / rows);
    for (int column = 0; column < columns; ++column) {
      const int x_begin = std::max(kBorder, column * width / columns);
      const int x_end = std::min(width - kBorder, (column + 1) * width / columns);
      const PointSelector::Candidate best = best_in_cell({x_begin, x_end, y_begin, y_end}, saliency,
                                                         disparity, level - disparity_level);
      if (best.disparity_px >= 0.0f && count < selector.candidates.size()) {
        selector.candidates[count++] = best;
      }
    }
  }
  return selector.candidates.first(count);
}

}  // namespace darkling
