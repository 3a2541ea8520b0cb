// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/synthetic/rover_path.h"

namespace darkling::synthetic {

// The even ground of the quarry, which the rover's wheels follow; scene frame, m.
[[nodiscard]] float quarry_ground(float x, float y, std::uint32_t seed);

// The quarry's surface: ground, stones and boulders kept clear of the way, the worked face in
// benches on the left, hills round the horizon.
class QuarryRelief {
 public:
  QuarryRelief(const RoverPath& path, std::uint32_t seed);

  struct Height {
    float z = 0.0f;      // m
    float stone = 0.0f;  // 0 ground … 1 on a stone
  };
  [[nodiscard]] Height at(float x, float y) const;

  // Signed distance to the left of the way, roughly.
  [[nodiscard]] float left_of_way(float x, float y) const;

 private:
  struct Scatter {
    float cell_m;
    float smallest_m, largest_m;  // radius
    float share;                  // of cells that hold a stone
    std::uint32_t seed;
  };
  void add_stones(const Scatter& scatter, float x, float y, Height& height) const;

  std::uint32_t seed_;
  float first_x_;
  std::vector<float> way_y_;  // every kWayStep_m of x
};

}  // namespace darkling::synthetic
