// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kernels/sample_residuals.h"

namespace darkling {

// Sums over all visible points: H = Σ w Jᵀ S J and g = Σ w Jᵀ b, with b = (bx, by), for the six
// unknowns (ρ, θ) of a right perturbation of T_current_key. H is divided by f², g by f.
struct NormalSums {
  static constexpr int kEntries = 21;
  float H[kEntries] = {};  // upper triangle, row by row
  float g[6] = {};
};

// With p = (x, y, f)/s in metres, s = f/z, the derivative of a point's pixel by a right
// perturbation of T_current_key, at the identity, is J = (Ju, Jv)ᵀ; divided by f, with X = x/f, Y =
// y/f:
//   Ju / f = [s/f, 0, -X s/f, -X Y, 1 + X², -Y],   Jv / f = [0, s/f, -Y s/f, -(1 + Y²), X Y, X].
// One robust weight a point, Geman and McClure's: w = 1 / (1 + squares · inverse_scale)²; 0 for
// points that are not in the image.
//
// @param inverse_scale  1 / (8 σ²), so that squares · inverse_scale = (distance / σ)².
// @pre what stands behind the last point is finite, as it is read and weighed by 0; its `squares`
//      say that it is not in the image.
// Exactness: single precision in a fixed order: point i goes to lane i mod 8, lanes are added up
// as ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)). Every variant equals the reference bit for bit.
// Cost: some 120 operations and 36 bytes a point.
using NormalEquationsFn = void(const TemplatePoints& points, const PointResiduals& residuals,
                               float focal_px, float inverse_scale, NormalSums& sums);

// Vectors of four lanes were tried: the reference compiles to just that, and SSE4.1 came out at
// 0.95 times its speed, NEON at 1.2 times its instructions.
NormalEquationsFn normal_equations_ref;
NormalEquationsFn normal_equations_avx2;

}  // namespace darkling
