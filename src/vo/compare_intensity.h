// SPDX-License-Identifier: Apache-2.0
// Grey levels in place of bit-planes, to see what bit-planes are worth. Stereo still matches census
// codes.
#pragma once

#include "kernels/kernel_table.h"

namespace darkling {

// `kernels`, with those two that make the pipeline compare grey levels.
//
// Thresholds stay those of bit-planes, and mean here:
// - kMinSaliency (select_points.cpp): |∂x| + |∂y| of 4 grey levels a pixel. Cells of the grid with
//   less give no point, where bit-planes take an edge's direction however faint it is. With a
//   quarter of it neither a car's drift nor a drone's RPE fell;
// - kMaxDistance (refine_disparity.cpp) and kCostTruncation (align.cpp): 80 grey levels, more than
//   most unrelated patches are apart, so that hardly any point is refused;
// - the costs of judge.cpp: views that have nothing to do with each other may cost less than
//   kLostCost, and a change of exposure costs as much as a wrong pose. Keyframes come of overlap
//   and baseline, and losses of overlap alone.
//
// Nothing makes up for brightness that is not constant: that is what is compared. Vignetting, which
// stays where it is while the scene moves, is enough to go wrong by half a metre in a frame, and
// did so on every robust scale from 2.4 to 300 medians; without it a rendered quarry is followed as
// by bit-planes (drift 0.10 and 0.06 %, RPE 0.39 and 0.51 mm).
[[nodiscard]] KernelTable compare_intensity(const KernelTable& kernels);

// The same codes as bit-planes, but all eight planes are the grey level, smoothed as much as
// bit-planes are from pixel to plane: both their blurs together are the binomial filter of order 8,
// a Gaussian of σ = 1.41 px; here it is rounded once, half up.
// Cost: 18 products a pixel, and the codes by the reference.
BitPlanesFn intensity_planes;

// Normal equations on a robust scale three times as wide, 2.4 medians: grey levels differ by
// far more where contrast is high, and such points, which hold the most, had no say while they were
// off. With the scale of bit-planes half of a car's frames did not converge (drift 10.9 in place
// of 2.2 %; RPE of a drone 72 in place of 1.4 mm); with this scale, bit-planes would lose a tenth.
NormalEquationsFn intensity_normal_equations;

}  // namespace darkling
