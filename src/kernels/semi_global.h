// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace darkling {

// Semi-global matching of census codes, one image row after another, from the top: the five paths
// that come from the left, the right, and the three neighbours of the row above. What is kept is
// one row of each path, so the memory is width × disparities and not height times as much.
// Costs lie disparity-fastest: cost[x * kDisparities + d].
// Source: Hirschmüller, "Stereo processing by semiglobal matching and mutual information", PAMI
// 2008, eq. (13); the single pass with five paths after OpenCV's documentation of StereoSGBM.

// Disparities 0 … 31 px: one vector of bytes, whatever the instruction set.
inline constexpr int kDisparities = 32;

// The bits in which a row of census codes differs from the other eye's, for every disparity:
//   cost[x * kDisparities + d] = popcount(left[x] ^ right[x - d]),  8 where x - d < 0.
// @param left            width codes.
// @param right_reversed  the right eye's row from its end: entry k is right[width - 1 - k]. Another
//                        kDisparities bytes behind it can be read.
using HammingRowFn = void(const std::uint8_t* left, const std::uint8_t* right_reversed, int width,
                          std::uint8_t* cost);
HammingRowFn hamming_row_ref;
HammingRowFn hamming_row_sse41;
HammingRowFn hamming_row_avx2;
HammingRowFn hamming_row_neon;

// Penalties for a step of one disparity, and for any larger one, between neighbours on a path.
struct SemiGlobalPenalties {
  std::uint8_t small_step = 0;
  std::uint8_t large_step = 0;
};

// The memory of the paths from the row above. Each pixel has kDisparities path costs with a guard
// of 255 on both sides, kPathGuard bytes wide.
inline constexpr int kPathGuard = 16;
inline constexpr int kPathStride = kDisparities + 2 * kPathGuard;
struct PathRows {
  int width = 0;
  // [direction][parity]: from above-left, above, above-right; this row and the one before.
  std::uint8_t* costs[3][2] = {};
  std::uint8_t* minima[3][2] = {};  // of each pixel's path costs
  int parity = 0;                   // which of the two is the row before
};

// Bytes of one `costs` row and one `minima` row, which have a guard pixel at both ends.
[[nodiscard]] constexpr int path_costs_bytes(int width) {
  return (width + 2) * kPathStride;
}
[[nodiscard]] constexpr int path_minima_bytes(int width) {
  return width + 2;
}

// Readies `rows` for the first row of an image: no path has cost anything yet.
void reset_path_rows(PathRows& rows);

// What one row of matching gives, besides the paths.
struct StereoRow {
  std::uint8_t* cost = nullptr;  // width × kDisparities: matching costs
  std::uint16_t* sum = nullptr;  // as many: Σ of the five path costs
  // The winners as sum · kDisparities + d, so that the least number is the least sum and, of equal
  // ones, the least disparity. For left pixels, among disparities that lie inside the right image;
  // …
  std::uint16_t* left_winner = nullptr;  // width
  // … for right pixels from the end of the row, as right_reversed. kDisparities more are written.
  std::uint16_t* right_winner = nullptr;
};

// Matching costs of one row, the Hamming distances summed over 3×3 pixels (beyond the ends of the
// row the nearest pixel stands in), the five paths over them, their sum and its winners; turns
// `paths` to the next row.
// @param hamming  of the row above, this one and the one below (at the border: this one again).
// @pre large_step is at most 183, so that path costs fit a byte: 72 + 183; their sums then fit a
// winner, (5 · 255) · 32 + 31.
// Exactness: integers; every variant equals the reference.
// Cost: 32 disparities take some 130 vector instructions a pixel.
using SemiGlobalRowFn = void(const std::uint8_t* const hamming[3], SemiGlobalPenalties penalties,
                             PathRows& paths, const StereoRow& row);
SemiGlobalRowFn semi_global_row_ref;
SemiGlobalRowFn semi_global_row_sse41;
SemiGlobalRowFn semi_global_row_avx2;
SemiGlobalRowFn semi_global_row_neon;

}  // namespace darkling
