// SPDX-License-Identifier: Apache-2.0
// A drift mined through rock: rough walls, an uneven floor with stones and a track, timber sets.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/synthetic/parallel.h"
#include "drivers/synthetic/scene.h"
#include "drivers/synthetic/surfaces.h"

namespace darkling::synthetic {

namespace {

enum MineMaterial { kRock, kFloor, kTimber, kRail };

constexpr float kRing_m = 0.075f;  // between rings of the tube
constexpr int kRingPoints = 120;   // around, about 7 cm apart
constexpr float kHalfWidth_m = 1.35f;
constexpr float kAxisHeight_m = 1.05f;  // of the ring's centre above the floor
constexpr float kCrown_m = 1.15f;       // from there to the roof
constexpr float kRailSpacing_m = 0.6f;
constexpr float kSetSpacing_m = 2.6f;

// The frame of the tunnel at an arc length: origin on the floor, axis level.
struct Station {
  Vec3f origin, forward, left;
  Station(const RoverPath& path, double s_m) {
    const WayPoint at = path.way(s_m);
    origin = Vec3f(static_cast<float>(at.p.x()), static_cast<float>(at.p.y()), 0.0f);
    forward = Vec3f(static_cast<float>(std::cos(at.axis_rad)),
                    static_cast<float>(std::sin(at.axis_rad)), 0.0f);
    left = Vec3f(-forward.y(), forward.x(), 0.0f);
  }
  [[nodiscard]] Vec3f at(float sideways, float up) const {
    return origin + sideways * left + up * Vec3f::UnitZ();
  }
};

// Distance from the ring's centre to the unworked profile: an arch on a flat floor.
float profile_radius(float cosine, float sine) {
  const float height = sine > 0.0f ? kCrown_m : kAxisHeight_m;
  const float power = sine > 0.0f ? 2.5f : 6.0f;
  return std::pow(
      std::pow(std::abs(cosine) / kHalfWidth_m, power) + std::pow(std::abs(sine) / height, power),
      -1.0f / power);
}

// How far the rock stands back from the profile: broken in slabs, then weathered.
float rock_relief(const Vec3f& p, std::uint32_t seed) {
  const Vec3f warped =
      p + 0.15f * Vec3f(gradient_noise(1.7f * p, seed + 1), gradient_noise(1.7f * p, seed + 2),
                        gradient_noise(1.7f * p, seed + 3));
  const float slabs = 3.2f * gradient_noise(1.3f * warped, seed + 4);
  const float step = std::floor(slabs) + smooth_step(0.3f, 0.7f, slabs - std::floor(slabs));
  return 0.055f * step + 0.10f * gradient_noise(0.8f * p, seed + 5) +
         0.055f * fractal_noise(3.1f * p, 3, 0.5f, seed + 6);
}

float floor_relief(const Vec3f& p, std::uint32_t seed) {
  const float stones = fractal_noise(5.0f * p, 2, 0.6f, seed + 12);
  return 0.025f * gradient_noise(1.6f * p, seed + 11) + 0.05f * std::max(stones - 0.15f, 0.0f);
}

Vertex tube_vertex(const Station& station, int point, float along_m, std::uint32_t seed) {
  // From the middle of the floor up the left wall, so that facets face inwards.
  const float angle = -0.5f * std::numbers::pi_v<float> +
                      2.0f * std::numbers::pi_v<float> * static_cast<float>(point % kRingPoints) /
                          static_cast<float>(kRingPoints);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const float radius = profile_radius(cosine, sine);
  const Vec3f nominal = station.at(radius * cosine, kAxisHeight_m + radius * sine);
  const float wall = smooth_step(0.05f, 0.35f, nominal.z());
  const float back = rock_relief(nominal, seed) * wall;
  // Spoil lies against the walls.
  const float spoil =
      smooth_step(0.65f, 1.25f, std::abs(radius * cosine)) *
      (0.06f + 0.22f * std::max(fractal_noise(2.3f * nominal, 3, 0.6f, seed + 20), 0.0f));
  const float rise = (1.0f - wall) * (floor_relief(nominal, seed) + spoil - 0.02f);
  Vertex vertex;
  vertex.p =
      nominal + back * (cosine * station.left + sine * Vec3f::UnitZ()) + rise * Vec3f::UnitZ();
  vertex.u = along_m;
  vertex.v = 9.0f * static_cast<float>(point) / static_cast<float>(kRingPoints);  // 3 repetitions
  const float damp = fractal_noise(0.7f * nominal, 3, 0.55f, seed + 30);
  vertex.tint = 1.0f + 0.45f * damp;
  vertex.light = 0.0f;
  return vertex;
}

void add_tube(const RoverPath& path, std::uint32_t seed, Mesh& mesh) {
  const int rings = static_cast<int>((path.last_m() - path.first_m()) / kRing_m);
  // Rows run around, columns along the way.
  VertexGrid grid(kRingPoints + 1, rings);
  for_each_row(rings, [&](int i) {
    const float along_m = kRing_m * static_cast<float>(i);
    const Station station(path, path.first_m() + along_m);
    for (int k = 0; k <= kRingPoints; ++k) {
      grid.at(k, i) = tube_vertex(station, k, along_m, seed);
    }
  });
  set_smooth_normals(grid, false);
  for (int i = 0; i < rings; ++i) {  // the seam closes
    const Vec3f n = (grid.at(0, i).n + grid.at(kRingPoints, i).n).normalized();
    grid.at(0, i).n = grid.at(kRingPoints, i).n = n;
  }
  const auto material = [](int around, int) {
    const int from_bottom = std::min(around, kRingPoints - 1 - around);
    return from_bottom < kRingPoints * 9 / 64 ? kFloor : kRock;
  };
  add_grid(grid, material, mesh);
}

void add_set(const Station& station, std::uint32_t seed, Mesh& mesh) {
  const float thick = 0.075f + 0.02f * unit_float(hash3(1, 2, 3, seed));
  const float lean = 0.08f * (unit_float(hash3(4, 5, 6, seed)) - 0.5f);
  const Vec3f up = Vec3f::UnitZ();
  for (float side : {-1.0f, 1.0f}) {
    const Vec3f post =
        (up + lean * side * station.left + 0.5f * lean * station.forward).normalized();
    const Vec3f across = station.forward - post * post.dot(station.forward);
    const Vec3f x = across.normalized();
    add_box({.centre = station.at(side * 1.12f, 0.93f),
             .half = {thick * x, thick * post.cross(x), 0.98f * post},
             .material = kTimber,
             .facet_m = 0.12f,
             .tint = 0.75f + 0.4f * unit_float(hash3(7, static_cast<int>(side), 9, seed))},
            0.012f, seed, mesh);
  }
  add_box({.centre = station.at(0.0f, 1.93f),
           .half = {1.1f * thick * station.forward, 1.38f * station.left, 1.1f * thick * up},
           .material = kTimber,
           .facet_m = 0.12f,
           .tint = 0.7f + 0.4f * unit_float(hash3(10, 11, 12, seed))},
          0.012f, seed + 1, mesh);
}

void add_track(const RoverPath& path, std::uint32_t seed, Mesh& mesh) {
  constexpr double kPiece_m = 0.3;
  int piece = 0;
  for (double s = path.first_m() + 0.5; s + kPiece_m < path.last_m(); s += kPiece_m, ++piece) {
    const Station a(path, s);
    const Station b(path, s + kPiece_m);
    for (float side : {-0.5f, 0.5f}) {
      const Vec3f from = a.at(side * kRailSpacing_m, 0.035f);
      const Vec3f to = b.at(side * kRailSpacing_m, 0.035f);
      const Vec3f half = 0.5f * (to - from);
      const Vec3f across = 0.022f * Vec3f(-half.y(), half.x(), 0.0f).normalized();
      add_box({.centre = 0.5f * (from + to),
               .half = {half, across, 0.03f * Vec3f::UnitZ()},
               .material = kRail,
               .facet_m = 0.3f},
              0.0f, seed + static_cast<std::uint32_t>(piece), mesh);
    }
    if (piece % 2 != 0) continue;
    const float turn = 0.1f * (unit_float(hash3(piece, 0, 0, seed)) - 0.5f);
    const Vec3f along = (a.forward + turn * a.left).normalized();
    add_box({.centre = a.at(0.05f * turn, -0.035f + 0.03f * unit_float(hash3(piece, 1, 0, seed))),
             .half = {0.075f * along, 0.46f * Vec3f(-along.y(), along.x(), 0.0f),
                      0.045f * Vec3f::UnitZ()},
             .material = kTimber,
             .facet_m = 0.12f,
             .tint = 0.6f + 0.5f * unit_float(hash3(piece, 2, 0, seed))},
            0.012f, seed + static_cast<std::uint32_t>(piece), mesh);
  }
}

}  // namespace

Scene make_mine(const RoverPath& path, std::uint32_t seed) {
  Scene scene;
  scene.textures.push_back(rock_surface(seed));
  scene.textures.push_back(gravel_surface(seed + 1));
  scene.textures.push_back(timber_surface(seed + 2));
  scene.materials = {{.texture = 0},                                   // kRock
                     {.texture = 1},                                   // kFloor
                     {.texture = 2},                                   // kTimber
                     {.texture = 0, .albedo = 0.6f, .relief = 0.2f}};  // kRail: rust
  add_tube(path, seed, scene.mesh);
  add_track(path, seed, scene.mesh);
  int set = 0;
  for (double s = path.first_m() + 1.7; s < path.last_m(); s += kSetSpacing_m, ++set) {
    add_set(Station(path, s), seed + 100 + static_cast<std::uint32_t>(set), scene.mesh);
  }
  // Above the cameras, tilted a little down.
  scene.headlamp = {.p_body = {0.12f, 0.0f, 0.56f},
                    .axis_body = Vec3f(1.0f, 0.0f, -0.10f).normalized(),
                    .intensity = 1.0f};
  scene.haze_per_m = 0.03f;
  scene.middle_grey = 0.045f;
  return scene;
}

}  // namespace darkling::synthetic
