// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/quarry_ground.h"

#include <algorithm>
#include <cmath>

#include "drivers/synthetic/noise.h"

namespace darkling::synthetic {

namespace {

constexpr float kWayStep_m = 0.1f;
constexpr float kClearance_m = 0.45f;  // between a stone's foot and the middle of the way

// Height over the ground of a boulder broken along planes, at (dx, dy) from its middle.
float boulder(float dx, float dy, float radius_m, std::uint32_t id) {
  float height = radius_m * (0.45f + 0.5f * unit_float(id * 3u));
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t h = hash3(static_cast<int>(k), 11, 13, id);
    const float angle = (static_cast<float>(k) + 0.8f * unit_float(h)) * 1.0472f;
    const float reach = radius_m * (0.65f + 0.35f * unit_float(h * 5u));
    const float steepness = 0.7f + 2.2f * unit_float(h * 7u);
    const float outwards = dx * std::cos(angle) + dy * std::sin(angle);
    height = std::min(height, steepness * (reach - outwards));
  }
  // A top that leans.
  return std::min(height, height * (0.8f + 0.4f * (dx + dy) / radius_m * (unit_float(id) - 0.5f)));
}

}  // namespace

float quarry_ground(float x, float y, std::uint32_t seed) {
  return 0.16f * gradient_noise({x / 5.0f, y / 5.0f, 0.5f}, seed + 1) +
         0.06f * gradient_noise({x / 2.1f, y / 2.1f, 0.5f}, seed + 2);
}

QuarryRelief::QuarryRelief(const RoverPath& path, std::uint32_t seed) : seed_(seed) {
  first_x_ = static_cast<float>(path.way(path.first_m()).p.x());
  for (double s = path.first_m(); s < path.last_m(); s += 0.02) {
    const Eigen::Vector2d p = path.way(s).p;
    const auto i = static_cast<std::size_t>((static_cast<float>(p.x()) - first_x_) / kWayStep_m);
    way_y_.resize(std::max(way_y_.size(), i + 1), static_cast<float>(p.y()));
  }
}

float QuarryRelief::left_of_way(float x, float y) const {
  const float at =
      std::clamp((x - first_x_) / kWayStep_m, 0.0f, static_cast<float>(way_y_.size() - 2));
  const auto i = static_cast<std::size_t>(at);
  return y - lerp(way_y_[i], way_y_[i + 1], at - static_cast<float>(i));
}

void QuarryRelief::add_stones(const Scatter& scatter, float x, float y, Height& height) const {
  const int cx = static_cast<int>(std::floor(x / scatter.cell_m));
  const int cy = static_cast<int>(std::floor(y / scatter.cell_m));
  for (int j = cy - 1; j <= cy + 1; ++j) {
    for (int i = cx - 1; i <= cx + 1; ++i) {
      const std::uint32_t id = hash3(i, j, 1, scatter.seed);
      if (unit_float(id * 11u) > scatter.share) continue;
      const float px =
          (static_cast<float>(i) + 0.15f + 0.7f * unit_float(id * 13u)) * scatter.cell_m;
      const float py =
          (static_cast<float>(j) + 0.15f + 0.7f * unit_float(id * 17u)) * scatter.cell_m;
      const float t = unit_float(id * 19u);
      float radius = lerp(scatter.smallest_m, scatter.largest_m, t * t);
      // The way is clear of all that the rover could not drive over.
      const float room = std::abs(left_of_way(px, py)) * 0.85f - kClearance_m;
      radius = std::min(radius, std::max(room, 0.06f));
      const float dx = x - px;
      const float dy = y - py;
      if (dx * dx + dy * dy > 1.4f * radius * radius) continue;
      const float rise = boulder(dx, dy, radius, id);
      if (rise <= 0.0f) continue;
      height.z += std::max(rise - 0.1f * radius, 0.0f);
      height.stone = 1.0f;
    }
  }
}

QuarryRelief::Height QuarryRelief::at(float x, float y) const {
  const Vec3f p(x, y, 0.3f);
  const float left = left_of_way(x, y);
  Height height{quarry_ground(x, y, seed_), 0.0f};
  const float near_way = 1.0f - smooth_step(0.2f, 0.8f, std::abs(left));
  height.z += (0.035f - 0.02f * near_way) * fractal_noise(2.2f * p, 4, 0.55f, seed_ + 5);

  // The worked face: two steep benches with a ragged edge.
  const float edge = left + 1.8f * fractal_noise(0.22f * p, 4, 0.5f, seed_ + 10);
  const float wall_1 = smooth_step(7.0f, 8.1f, edge);
  const float wall_2 = smooth_step(14.0f, 15.6f, edge);
  const float broken = fractal_noise(0.9f * p, 4, 0.55f, seed_ + 20);
  height.z += 3.4f * wall_1 + 4.5f * wall_2 + 0.35f * broken * smooth_step(6.0f, 8.0f, edge);
  height.stone = std::max(wall_1 * (1.0f - smooth_step(9.0f, 10.0f, edge)),
                          wall_2 * (1.0f - smooth_step(16.5f, 18.0f, edge)));

  // Hills beyond.
  const float away = std::hypot(x - 5.0f, y);
  const float hills = smooth_step(40.0f, 170.0f, away);
  if (hills > 0.0f) {
    height.z += hills * (9.0f + 16.0f * fractal_noise(0.011f * p, 5, 0.5f, seed_ + 30));
  }
  if (away < 45.0f) {
    add_stones({1.2f, 0.10f, 0.58f, 0.8f, seed_ + 40}, x, y, height);
    add_stones({0.42f, 0.05f, 0.16f, 0.6f, seed_ + 41}, x, y, height);
  }
  return height;
}

}  // namespace darkling::synthetic
