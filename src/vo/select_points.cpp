// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "vo/keyframe_template.h"
#include "vo/match_stereo.h"

namespace darkling {

namespace {

// Gradients reach one pixel further and bilinear sampling two.
constexpr int kBorder = 2;
// Σ|∂φ| below which a pixel is flat: an edge of the planes is worth about 255 a plane it is in.
constexpr int kMinSaliency = 64;

// A saliency and its row in one number, so that the greatest number is the most salient pixel and,
// of equal ones, the uppermost: (saliency / 2) · 16 + 15 - row. Half a saliency, at most 2040, and
// four bits of row fit a signed 16-bit number, for which every processor has a maximum.
constexpr int kStripRows = 16;
std::int16_t strength(std::uint16_t saliency, int row) {
  return static_cast<std::int16_t>((saliency >> 1) * kStripRows + (kStripRows - 1 - row));
}

// For each pixel of a level: all bits, or none where no point may be.
using MaskRow = std::array<std::uint16_t, kMaxWidth>;

void allow_known(const float* disparity, int width, MaskRow& mask) {
  for (int x = 0; x < width; ++x) mask[x] = disparity[x] >= 0.0f ? 0xffff : 0;
}

// Allows the finer pixels that became part of one of row v, where the eyes agree on all its
// neighbours too, and those lie on one surface. Beside others, the search that goes on from here
// picks the wrong side of an edge.
void allow_steady(const DisparityPyramid::At& coarse, int v, MaskRow& mask) {
  constexpr float kSameSurfacePx = 1.5f;
  const ImageView<const float>& disparity = coarse.disparity;
  const int width = disparity.width;
  const float* above = disparity.row(std::max(v - 1, 0));
  const float* here = disparity.row(v);
  const float* below = disparity.row(std::min(v + 1, disparity.height - 1));
  std::array<float, kMaxStereoWidth> least;  // of the three rows; below 0 where one is unknown
  std::array<float, kMaxStereoWidth> greatest;
  for (int u = 0; u < width; ++u) {
    least[u] = std::min(std::min(above[u], here[u]), below[u]);
    greatest[u] = std::max(std::max(above[u], here[u]), below[u]);
  }
  for (int u = 0; u < width; ++u) {
    const int left = std::max(u - 1, 0);
    const int right = std::min(u + 1, width - 1);
    const float low = std::min(std::min(least[left], least[u]), least[right]);
    const float high = std::max(std::max(greatest[left], greatest[u]), greatest[right]);
    const bool is_steady = (low >= 0.0f) & (high - low <= kSameSurfacePx);
    std::fill_n(&mask[u << coarse.halvings], 1 << coarse.halvings,
                static_cast<std::uint16_t>(is_steady ? 0xffff : 0));
  }
}

// Takes the saliency from pixels that may not be chosen: those without a disparity, and the odd
// last column or row of an image that was halved, which no disparity stands for.
void clear_unknown(const DisparityPyramid::At& disparity, ImageView<std::uint16_t> saliency) {
  const int side = 1 << disparity.halvings;
  MaskRow mask = {};
  for (int y = 0; y < saliency.height; ++y) {
    const int v = y >> disparity.halvings;
    if (v >= disparity.disparity.height) {
      mask.fill(0);
    } else if (disparity.halvings == 0) {
      allow_known(disparity.disparity.row(v), saliency.width, mask);
    } else if (y % side == 0) {
      allow_steady(disparity, v, mask);
    }
    std::uint16_t* __restrict out = saliency.row(y);
    for (int x = 0; x < saliency.width; ++x) out[x] = out[x] & mask[x];
  }
}

// The strengths of the strongest pixel of each column in rows [y_begin, y_end), at most kStripRows.
void find_strongest(ImageView<const std::uint16_t> saliency, int y_begin, int y_end,
                    std::span<std::int16_t> strongest) {
  std::fill(strongest.begin(), strongest.end(), std::int16_t{0});
  for (int y = y_begin; y < y_end; ++y) {
    const std::uint16_t* row = saliency.row(y);
    std::int16_t* __restrict out = strongest.data();
    for (int x = 0; x < saliency.width; ++x) {
      out[x] = std::max(out[x], strength(row[x], y - y_begin));
    }
  }
}

// The most salient pixel of a strip's columns [x_begin, x_end), the leftmost of equal ones.
PointSelector::Candidate strongest_of(std::span<const std::int16_t> strongest, int x_begin,
                                      int x_end, int y_begin) {
  unsigned best = 0;  // strength, then how far to the left
  for (int x = x_begin; x < x_end; ++x) {
    best = std::max(best,
                    static_cast<unsigned>(strongest[x]) << 16 | static_cast<unsigned>(0xffff - x));
  }
  const int key = static_cast<int>(best >> 16);
  return {static_cast<std::uint16_t>(0xffff - (best & 0xffff)),
          static_cast<std::uint16_t>(y_begin + kStripRows - 1 - key % kStripRows),
          static_cast<std::uint16_t>(key / kStripRows * 2), kNoDisparity};
}

// The grid of cells, each of which gives a candidate.
struct Grid {
  int columns;
  int rows;
};

Grid make_grid(int width, int height, int cells) {
  const double cell_px = std::max(1.0, std::sqrt(double(width) * height / cells));
  return {static_cast<int>(width / cell_px), static_cast<int>(height / cell_px)};
}

// Where part `i` of `parts` of an axis begins, clear of the border.
int part_begin(int size, int parts, int i) {
  return std::clamp(i * size / parts, kBorder, std::max(size - kBorder, kBorder));
}

// Merges one strip of a row of cells into its candidates, a candidate a column.
void keep_stronger(std::span<const std::uint16_t> column_begins,
                   std::span<const std::int16_t> strongest, int y_begin,
                   std::span<PointSelector::Candidate> row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const PointSelector::Candidate best =
        strongest_of(strongest, column_begins[i], column_begins[i + 1], y_begin);
    if (best.saliency > row[i].saliency) row[i] = best;
  }
}

}  // namespace

PointSelector allocate_point_selector(const RectifiedRig& rig, int points_per_level, Arena& arena) {
  PointSelector selector;
  selector.saliency = arena.allocate_image<std::uint16_t>(rig.width, rig.height, "saliency");
  selector.strongest = arena.allocate<std::int16_t>(rig.width, "strongest of columns");
  selector.column_begins = arena.allocate<std::uint16_t>(rig.width + 1, "columns of cells");
  selector.candidates =
      arena.allocate<PointSelector::Candidate>(points_per_level, "point candidates");
  return selector;
}

std::span<PointSelector::Candidate> select_points(const KernelTable& kernels,
                                                  const PyramidLevel& planes,
                                                  const DisparityPyramid::At& disparity,
                                                  const PointSelector& selector) {
  const int width = planes.grey.width;
  const int height = planes.grey.height;
  const ImageView<std::uint16_t> saliency{selector.saliency.data, width, height,
                                          selector.saliency.stride};
  kernels.saliency(planes.planes, saliency);
  clear_unknown(disparity, saliency);

  const Grid grid = make_grid(width, height, static_cast<int>(selector.candidates.size()));
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (int i = 0; i <= grid.columns; ++i) {
    selector.column_begins[i] = static_cast<std::uint16_t>(part_begin(width, grid.columns, i));
  }
  const std::span<std::int16_t> strongest =
      selector.strongest.first(static_cast<std::size_t>(width));
  std::size_t count = 0;
  for (int row = 0; row < grid.rows; ++row) {
    // Cells of this row are put behind the candidates so far, and those that hold one moved up.
    const std::span<PointSelector::Candidate> cells = selector.candidates.subspan(count, columns);
    std::fill(cells.begin(), cells.end(), PointSelector::Candidate{0, 0, kMinSaliency, -1.0f});
    const int y_end = part_begin(height, grid.rows, row + 1);
    for (int y = part_begin(height, grid.rows, row); y < y_end; y += kStripRows) {
      find_strongest(saliency, y, std::min(y + kStripRows, y_end), strongest);
      keep_stronger(selector.column_begins, strongest, y, cells);
    }
    for (const PointSelector::Candidate& cell : cells) {
      if (cell.saliency <= kMinSaliency) continue;
      PointSelector::Candidate& chosen = selector.candidates[count++];
      chosen = cell;
      chosen.disparity_px = disparity(cell.x, cell.y);
    }
  }
  return selector.candidates.first(count);
}

}  // namespace darkling
