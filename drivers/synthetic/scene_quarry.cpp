// SPDX-License-Identifier: Apache-2.0
// An open quarry: broken rock on uneven ground, a low sun with long shadows, a far horizon.
#include <algorithm>
#include <cmath>

#include "drivers/synthetic/parallel.h"
#include "drivers/synthetic/quarry_ground.h"
#include "drivers/synthetic/scene.h"
#include "drivers/synthetic/surfaces.h"

namespace darkling::synthetic {

namespace {

enum QuarryMaterial { kGravel, kRock, kClouds };

constexpr float kNet_m = 0.045f;           // between the net's lines near the way …
constexpr float kGrowth = 1.07f;           // … and from line to line beyond
constexpr float kSunElevation = 0.27f;     // tangent: 15°
constexpr float kSunAzimuth_rad = -1.25f;  // right and a little ahead
constexpr float kSkyLight = 0.26f;  // irradiance from the sky on level ground; the sun's is 1

// Lines of a net along one axis: even in [low, high], then growing out to `reach` on either side.
std::vector<float> net_lines(float low, float high, float reach_low, float reach_high) {
  std::vector<float> lines;
  float step = kNet_m;
  for (float x = low; x > reach_low; x -= step, step *= kGrowth) lines.push_back(x);
  std::reverse(lines.begin(), lines.end());
  const int count = static_cast<int>((high - low) / kNet_m);
  for (int i = 1; i < count; ++i) lines.push_back(low + kNet_m * static_cast<float>(i));
  step = kNet_m;
  for (float x = low + kNet_m * static_cast<float>(count); x < reach_high;
       x += step, step *= kGrowth) {
    lines.push_back(x);
  }
  return lines;
}

// The net of ground vertices with its lines, for look-ups of height in between.
struct Net {
  std::vector<float> x, y;
  VertexGrid grid;
  std::vector<float> stone;

  Net(std::vector<float> x_, std::vector<float> y_)
      : x(std::move(x_)),
        y(std::move(y_)),
        grid(static_cast<int>(y.size()), static_cast<int>(x.size())),
        stone(x.size() * y.size()) {}

  [[nodiscard]] float height(float px, float py) const {
    const auto cell = [](const std::vector<float>& lines, float v) {
      const auto next = std::upper_bound(lines.begin() + 1, lines.end() - 1, v);
      return static_cast<int>(next - lines.begin()) - 1;
    };
    const int c = cell(x, px);
    const int r = cell(y, py);
    const float s = std::clamp((px - x[c]) / (x[c + 1] - x[c]), 0.0f, 1.0f);
    const float t = std::clamp((py - y[r]) / (y[r + 1] - y[r]), 0.0f, 1.0f);
    return lerp(lerp(grid.at(r, c).p.z(), grid.at(r, c + 1).p.z(), s),
                lerp(grid.at(r + 1, c).p.z(), grid.at(r + 1, c + 1).p.z(), s), t);
  }
};

Net make_net(const RoverPath& path, const QuarryRelief& relief, std::uint32_t seed) {
  float low_y = 0.0f;
  float high_y = 0.0f;
  for (double s = 0.0; s < path.end_m(); s += 0.1) {
    low_y = std::min(low_y, static_cast<float>(path.way(s).p.y()));
    high_y = std::max(high_y, static_cast<float>(path.way(s).p.y()));
  }
  const auto end_x = static_cast<float>(path.way(path.end_m()).p.x());
  Net net(net_lines(-0.6f, end_x + 5.0f, -12.0f, end_x + 380.0f),
          net_lines(low_y - 3.0f, high_y + 3.0f, low_y - 320.0f, high_y + 320.0f));
  for_each_row(net.grid.rows, [&](int r) {
    for (int c = 0; c < net.grid.columns; ++c) {
      const float x = net.x[c];
      const float y = net.y[r];
      const QuarryRelief::Height height = relief.at(x, y);
      Vertex& vertex = net.grid.at(r, c);
      vertex.p = Vec3f(x, y, height.z);
      // Sheared with the height, so that steep faces are not smeared from top to bottom.
      vertex.u = x + 0.6f * height.z;
      vertex.v = y + 0.8f * height.z;
      const float damp = fractal_noise(0.33f * Vec3f(x, y, 0.7f), 4, 0.6f, seed + 60);
      vertex.tint =
          (1.0f + 0.4f * damp) * (1.0f - 0.3f * smooth_step(50.0f, 150.0f, std::hypot(x, y)));
      net.stone[static_cast<std::size_t>(r) * net.grid.columns + c] = height.stone;
    }
  });
  set_smooth_normals(net.grid, false);
  return net;
}

// How far the ground towards the sun stands above the sun's ray, as Vertex::shadow_m wants it.
float shadow_at(const Net& net, const Vec3f& p, const Vec3f& towards) {
  float horizon = -1.0f;
  float distance = 1.0f;
  for (float t = 0.07f; t < 26.0f; t += std::max(0.05f, 0.08f * t)) {
    const float tangent =
        (net.height(p.x() + t * towards.x(), p.y() + t * towards.y()) - p.z()) / t;
    if (tangent <= horizon) continue;
    horizon = tangent;
    distance = t;
  }
  return (horizon - kSunElevation) * std::max(distance, 1.0f);
}

// The share of the sky that a place sees: less in hollows and at the foot of stones.
float openness(const Net& net, const Vec3f& p) {
  float walls = 0.0f;
  for (int k = 0; k < 6; ++k) {
    const float angle = 1.0472f * static_cast<float>(k);
    float tangent = 0.0f;
    for (float t : {0.09f, 0.25f, 0.7f}) {
      const float rise =
          net.height(p.x() + t * std::cos(angle), p.y() + t * std::sin(angle)) - p.z();
      tangent = std::max(tangent, rise / t);
    }
    walls += tangent * tangent / (1.0f + tangent * tangent);
  }
  return 1.0f - 0.85f * walls / 6.0f;
}

}  // namespace

Scene make_quarry(const RoverPath& path, std::uint32_t seed) {
  Scene scene;
  scene.textures.push_back(gravel_surface(seed));
  scene.textures.push_back(rock_surface(seed + 1));
  scene.textures.push_back(cloud_surface(seed + 2));
  scene.materials = {{.texture = 0, .relief = 0.7f},   // kGravel
                     {.texture = 1, .albedo = 1.05f},  // kRock
                     {.texture = 2}};                  // kClouds
  const QuarryRelief relief(path, seed);
  Net net = make_net(path, relief, seed);
  const Vec3f towards(std::cos(kSunAzimuth_rad), std::sin(kSunAzimuth_rad), 0.0f);
  for_each_row(net.grid.rows, [&](int r) {
    for (int c = 0; c < net.grid.columns; ++c) {
      Vertex& vertex = net.grid.at(r, c);
      vertex.shadow_m = shadow_at(net, vertex.p, towards);
      vertex.light = kSkyLight * openness(net, vertex.p);
    }
  });
  add_grid(
      net.grid,
      [&](int r, int c) {
        const std::size_t i = static_cast<std::size_t>(r) * net.grid.columns + c;
        return net.stone[i] + net.stone[i + net.grid.columns + 1] > 0.9f ? kRock : kGravel;
      },
      scene.mesh);
  scene.sun = {.direction = Vec3f(towards.x(), towards.y(), kSunElevation).normalized(),
               .irradiance = 1.0f};
  scene.sky = {.zenith = 0.26f, .horizon = 0.42f, .cloud_texture = 2};
  scene.haze_per_m = 0.0025f;
  scene.middle_grey = 0.24f;
  return scene;
}

}  // namespace darkling::synthetic
