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

// Which two levels of a pyramid a look-up blends.
struct Footprint {
  int fine = 0;
  int coarse = 0;
  float coarse_share = 0.0f;
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

  // @param axis_x, axis_y  how (u, v) moves across the footprint's width and height, m.
  [[nodiscard]] Footprint footprint(const Eigen::Vector2f& axis_x,
                                    const Eigen::Vector2f& axis_y) const;

  // The mean over a footprint around (u, v), in m.
  [[nodiscard]] SurfaceSample sample(float u, float v, const Footprint& footprint) const;

 private:
  // A texel is albedo, slope_u, slope_v (both offset by 128), from the lowest byte up.
  struct Level {
    int size = 0;
    float texels_per_m = 0.0f;
    std::vector<std::uint32_t> texels;

    // Texels lie in blocks of 4 × 4, a cache line each, with a spare block after every row of
    // blocks so that what is one above the other does not fall into the same cache set.
    [[nodiscard]] std::size_t place(int x, int y) const {
      const int block = (y >> 2) * ((size >> 2) + 1) + (x >> 2);
      return static_cast<std::size_t>((block << 4) + ((y & 3) << 2) + (x & 3));
    }
    [[nodiscard]] std::uint32_t at(int x, int y) const { return texels[place(x, y)]; }
  };

  void add_level(int size, const std::vector<float>& values);
  static void add_bilinear(const Level& level, float u, float v, float weight, float* sum);

  float extent_m_;
  float texels_per_m_;
  std::vector<Level> levels_;
};

}  // namespace darkling::synthetic
