// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace darkling {

// Two ways to compare a patch of the left eye with one of the right, in the same row: by census
// codes for whole disparities, by smoothed bit-planes for fractions of a pixel.

// Half the side of the patch of codes.
inline constexpr int kCodePatchRadius = 3;

// Hamming distances of two 7×7 patches of census codes, for `count` disparities in a row:
//   cost[k] = Σ popcount(left(x + i, y + j) ^ right(x + i - first - k, y + j)),  i, j in -3…3.
// @param left   code at (x, y).
// @param right  code at (x - first, y): the patch of the first disparity.
// @pre the patches lie inside the images, and a row can be read one code beyond its end.
// Exactness: integers; every variant equals the reference.
using MatchCodesFn = void(const std::uint8_t* left, std::ptrdiff_t left_stride,
                          const std::uint8_t* right, std::ptrdiff_t right_stride, int count,
                          int* cost);
MatchCodesFn match_codes_ref;
MatchCodesFn match_codes_sse41;
MatchCodesFn match_codes_avx2;
MatchCodesFn match_codes_neon;

// Half the side of the patch of planes. Smoothing has already spread every bit over some 3 px;
// patches of 5 and 7 px only add surfaces that slant away (1.16 and 1.31 % drift in place of 1.11 %
// on a car's road, steps of 3.6 m 1.59 % in place of 1.39 %).
inline constexpr int kPlanePatchRadius = 1;
inline constexpr int kPlanePatchValues =
    (2 * kPlanePatchRadius + 1) * (2 * kPlanePatchRadius + 1) * 8;

// Sums over the values of a patch: g the left gradient along the row, r = right - left.
struct PatchFit {
  std::int32_t gr = 0;  // Σ g r, in 1/32
  std::int32_t gg = 0;  // Σ g², in 1/4
  std::int32_t rr = 0;  // Σ r², in 1/256
};

// Compares 3×3 pixels of smoothed bit-planes, the right ones between two pixels of a row.
// @param left   planes at pixel (x, y); two pixels to either side and one row above and below
// exist.
// @param right  planes at pixel (u, y); from u - 1 to u + 2, and as many rows.
// @param fraction_q12  the patch of the right eye lies this much to the right of u, in 1/4096 px.
// Fixed point: r is taken at 1/16, rounded half up; Σ r² fits 31 bits.
// Exactness: integers; every variant equals the reference.
using ComparePatchFn = PatchFit(const std::uint8_t* left, std::ptrdiff_t left_stride,
                                const std::uint8_t* right, std::ptrdiff_t right_stride,
                                int fraction_q12);
ComparePatchFn compare_patch_ref;
ComparePatchFn compare_patch_sse41;
ComparePatchFn compare_patch_neon;

}  // namespace darkling
