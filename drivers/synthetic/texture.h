// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/synthetic/noise.h"

namespace darkling::synthetic {

// What a surface shows at one place, filtered over a footprint.
struct SurfaceSample {
  float albedo = 0.0f;   // 0…1
  float slope_u = 0.0f;  // of the fine relief: ∂height/∂u, m per m
  float slope_v = 0.0f;
};

// A square, wrapping map of albedo and fine relief, with all its reductions (a mip pyramid) so that
// a look-up over any footprint is the mean over it and does not alias.
class Texture {
 public:
  // @param size      texels across, a power of two.
  // @param extent_m  metres across one repetition.
  // @param albedo    size × size, 0…1.
  // @param height_m  size × size, relief along the normal, or empty for none.
  Texture(int size, float extent_m, const std::vector<float>& albedo,
          const std::vector<float>& height_m);

  [[nodiscard]] float extent_m() const { return extent_m_; }
  [[nodiscard]] float texels_per_m() const { return texels_per_m_; }

  // Mean over a footprint: an ellipse at (u, v) with half the axes given, all in m. The longer axis
  // is walked in up to kMaxTaps steps, each filtered by the shorter one.
  [[nodiscard]] SurfaceSample sample(float u, float v, const Eigen::Vector2f& axis_x,
                                     const Eigen::Vector2f& axis_y) const;

 private:
  static constexpr int kMaxTaps = 4;
  // albedo, slope_u, slope_v (both offset by 128), spare: four bytes so that four lanes run alike.
  struct Texel {
    std::uint8_t c[4];
  };
  struct Level {
    int size = 0;
    std::vector<Texel> texels;
  };

  void add_level(int size, const std::vector<float>& values);
  void add_bilinear(const Level& level, float u, float v, float weight, float* sum) const;

  float extent_m_;
  float texels_per_m_;
  std::vector<Level> levels_;
};

}  // namespace darkling::synthetic
