// SPDX-License-Identifier: Apache-2.0
#include "kernels/normal_equations.h"

namespace darkling {

namespace {

// One number of each of eight points. Loops over lanes compile to vectors.
struct Lanes {
  float v[kPointLanes];
};

template <class Operation>
Lanes for_each_lane(const Operation& operation) {
  Lanes out;
  for (int k = 0; k < kPointLanes; ++k) out.v[k] = operation(k);
  return out;
}
Lanes operator*(const Lanes& a, const Lanes& b) {
  return for_each_lane([&](int k) { return a.v[k] * b.v[k]; });
}
Lanes operator+(const Lanes& a, const Lanes& b) {
  return for_each_lane([&](int k) { return a.v[k] + b.v[k]; });
}
Lanes operator-(const Lanes& a) {
  return for_each_lane([&](int k) { return -a.v[k]; });
}
Lanes all(float value) {
  return for_each_lane([=](int) { return value; });
}
Lanes load(const float* from) {
  return for_each_lane([=](int k) { return from[k]; });
}

float add_up(const Lanes& lanes) {
  const float* v = lanes.v;
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

// The weights of eight points.
Lanes robust_weights(const float* squares, float inverse_scale) {
  return for_each_lane([=](int k) {
    const float d = 1.0f + squares[k] * inverse_scale;
    const float w = 1.0f / d;
    return squares[k] < 0.0f ? 0.0f : w * w;
  });
}

struct LaneSums {
  Lanes H[NormalSums::kEntries] = {};
  Lanes g[6] = {};
};

void add_8(const TemplatePoints& points, const PointResiduals& residuals, int i,
           float inverse_focal, float inverse_scale, LaneSums& sums) {
  const Lanes w = robust_weights(residuals.squares + i, inverse_scale);
  const Lanes f = all(inverse_focal);
  const Lanes X = load(points.x + i) * f;
  const Lanes Y = load(points.y + i) * f;
  const Lanes s = load(points.inverse_depth_focal + i) * f;
  const Lanes XY = X * Y;
  const Lanes one = all(1.0f);
  const Lanes zero = all(0.0f);
  const Lanes Ju[6] = {s, zero, -(X * s), -XY, one + X * X, -Y};
  const Lanes Jv[6] = {zero, s, -(Y * s), -(one + Y * Y), XY, X};
  const Lanes Sxx = w * load(points.Sxx + i);
  const Lanes Sxy = w * load(points.Sxy + i);
  const Lanes Syy = w * load(points.Syy + i);
  const Lanes bx = w * load(residuals.bx + i);
  const Lanes by = w * load(residuals.by + i);
  Lanes* H = sums.H;
  for (int a = 0; a < 6; ++a) {
    const Lanes SJu = Sxx * Ju[a] + Sxy * Jv[a];
    const Lanes SJv = Sxy * Ju[a] + Syy * Jv[a];
    for (int b = a; b < 6; ++b, ++H) *H = *H + (SJu * Ju[b] + SJv * Jv[b]);
    sums.g[a] = sums.g[a] + (bx * Ju[a] + by * Jv[a]);
  }
}

}  // namespace

void normal_equations_ref(const TemplatePoints& points, const PointResiduals& residuals,
                          float focal_px, float inverse_scale, NormalSums& sums) {
  LaneSums lanes;
  const float inverse_focal = 1.0f / focal_px;
  for (int i = 0; i < points.count; i += kPointLanes) {
    add_8(points, residuals, i, inverse_focal, inverse_scale, lanes);
  }
  for (int i = 0; i < NormalSums::kEntries; ++i) sums.H[i] = add_up(lanes.H[i]);
  for (int i = 0; i < 6; ++i) sums.g[i] = add_up(lanes.g[i]);
}

}  // namespace darkling
