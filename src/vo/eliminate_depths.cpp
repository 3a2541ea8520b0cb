// SPDX-License-Identifier: Apache-2.0
#include "vo/eliminate_depths.h"

#include <span>

namespace darkling {

namespace {

using Block = Matrix6;

// Σ a b c over `count` points, in an order of its own: of eight lanes, then as kernels add lanes
// up.
float sum_products(const float* a, const float* b, const float* c, int count) {
  float lanes[kPointLanes] = {};
  for (int i = 0; i < count; i += kPointLanes) {
    for (int k = 0; k < kPointLanes; ++k) lanes[k] += a[i + k] * b[i + k] * c[i + k];
  }
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) +
         ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

// H - C C ᵀ / H_depth of the motions against keyframes a and b later.
Block eliminate(const RelativeEquations& relative, const DepthEquations& depths, int count, int a,
                int b) {
  Block out = a == b ? relative.H[a] : Block(Block::Zero());
  for (int i = 0; i < 6; ++i) {
    for (int j = a == b ? i : 0; j < 6; ++j) {
      const double product =
          static_cast<double>(sum_products(depths.C[a][i], depths.C[b][j], depths.H, count));
      out(i, j) -= product;
      if (a == b && i != j) out(j, i) -= product;
    }
  }
  return out;
}

class PoseSystem {
 public:
  PoseSystem(std::span<double> H, std::array<double, kMaxWindowUnknowns>& g) : H_(H), g_(g) {}

  void add(int a, int b, const Block& block) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) H_[(6 * a + i) * kMaxWindowUnknowns + 6 * b + j] += block(i, j);
    }
  }
  void add(int a, const Vector6& part) {
    for (int i = 0; i < 6; ++i) g_[6 * a + i] += part[i];
  }

 private:
  std::span<double> H_;
  std::array<double, kMaxWindowUnknowns>& g_;
};

}  // namespace

// η_a = ξ_host - Ad_a ξ_(host + a + 1): from relative motions to the keyframes' own.
void eliminate_depths(const RelativeEquations& relative, const DepthEquations& depths,
                      int point_count, int host, WindowEquations& equations) {
  PoseSystem system(equations.H, equations.g);
  for (int a = 0; a < relative.count; ++a) {
    const Block& Ad_a = relative.Ad_host_later[a];
    Vector6 g = relative.g[a];
    for (int k = 0; k < 6; ++k) {
      g[k] -= static_cast<double>(sum_products(depths.C[a][k], depths.g, depths.H, point_count));
    }
    system.add(host, g);
    system.add(host + a + 1, -Ad_a.transpose() * g);
    for (int b = a; b < relative.count; ++b) {
      const Block& Ad_b = relative.Ad_host_later[b];
      const Block H = eliminate(relative, depths, point_count, a, b);
      const Block H_b = H * Ad_b;
      const Block aH = Ad_a.transpose() * H;
      const Block aH_b = Ad_a.transpose() * H_b;
      system.add(host, host, H);
      system.add(host, host + b + 1, -H_b);
      system.add(host + a + 1, host, -aH);
      system.add(host + a + 1, host + b + 1, aH_b);
      if (a == b) continue;  // else the transposed of all four
      system.add(host, host, H.transpose());
      system.add(host + b + 1, host, -H_b.transpose());
      system.add(host, host + a + 1, -aH.transpose());
      system.add(host + b + 1, host + a + 1, aH_b.transpose());
    }
  }
}

}  // namespace darkling
