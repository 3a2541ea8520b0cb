// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/image_view.h"

namespace darkling {

// Semi-global matching of one image row after another, from the top: the five paths that come from
// the left, the right, and the three neighbours of the row above. What is kept is one row of each
// path, so the memory is width × disparities and not height times as much.
// Costs lie disparity-fastest: cost[x * disparities + d].
// Source: Hirschmüller, "Stereo processing by semiglobal matching and mutual information", PAMI
// 2008, eq. (13); the single pass with five paths after OpenCV's documentation of StereoSGBM.

// The bits in which a row of census codes differs from the other eye's, for every disparity:
//   cost[x * D + d] = popcount(left[x] ^ right[x - d]),  8 where x - d < 0.
using HammingRowFn = void(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
                          int disparities, std::span<std::uint8_t> cost);
HammingRowFn hamming_row_ref;

// Penalties for a step of one disparity, and for any larger one, between neighbours on a path.
struct SemiGlobalPenalties {
  std::uint8_t small_step = 0;
  std::uint8_t large_step = 0;
};

// The memory of the paths from the row above. Each pixel has `disparities` path costs with a guard
// of 255 on both sides, kPathGuard bytes wide: stride disparities + 2 · kPathGuard.
inline constexpr int kPathGuard = 16;
struct PathRows {
  int width = 0;
  int disparities = 0;  // a multiple of 16
  // [direction][parity]: from above-left, above, above-right; this row and the one before.
  std::uint8_t* costs[3][2] = {};
  std::uint8_t* minima[3][2] = {};  // of each pixel's path costs
  std::uint8_t* along = nullptr;    // two pixels' worth, for the paths along the row
  int parity = 0;                   // which of the two is the row before
};

// Bytes of one `costs` row, one `minima` row (which has a guard pixel at both ends) and `along`.
[[nodiscard]] constexpr int path_costs_bytes(int width, int disparities) {
  return (width + 2) * (disparities + 2 * kPathGuard);
}
[[nodiscard]] constexpr int path_minima_bytes(int width) {
  return width + 2;
}
[[nodiscard]] constexpr int path_along_bytes(int disparities) {
  return 2 * (disparities + 2 * kPathGuard);
}

// Readies `rows` for the first row of an image: no path has cost anything yet.
void reset_path_rows(PathRows& rows);

// Adds up the five paths over one row of matching costs and turns `rows` to the next row.
// @param cost  matching costs, at most 255 - large_step.
// @param sum   Σ of the five path costs, width × disparities.
using SemiGlobalRowFn = void(std::span<const std::uint8_t> cost, SemiGlobalPenalties penalties,
                             PathRows& rows, std::span<std::uint16_t> sum);
SemiGlobalRowFn semi_global_row_ref;

}  // namespace darkling
