// SPDX-License-Identifier: Apache-2.0
// A corridor with corners: painted plaster in two tones, doors, notice boards, a tiled floor, a
// ceiling of boards with lamps.
#include <algorithm>
#include <cmath>

#include "drivers/synthetic/floor_plan.h"
#include "drivers/synthetic/parallel.h"
#include "drivers/synthetic/scene.h"
#include "drivers/synthetic/surfaces.h"

namespace darkling::synthetic {

namespace {

enum CorridorMaterial { kPlaster, kTiles, kCeiling, kDoor, kPoster, kFrame, kMetal, kLamp };

constexpr float kHeight_m = 2.55f;
constexpr float kDado_m = 1.12f;  // up to where the darker paint goes
constexpr float kDoorWidth_m = 0.92f;
constexpr float kDoorHeight_m = 2.04f;
constexpr float kRecess_m = 0.09f;
constexpr float kLampSpacing_m = 2.4f;

// Part of a wall: from s0 to s1 along it and from z0 to z1 above the floor, m.
struct Area {
  float s0, s1, z0, z1;
};

struct Finish {
  int material;
  float tint;
};

struct Builder {
  Mesh& mesh;
  std::uint32_t seed;

  // A piece of the wall's plane, `out_m` towards the room.
  void face(const Wall& w, const Area& area, float out_m, const Finish& finish) {
    if (area.s1 - area.s0 < 0.005f) return;
    add_panel({.origin = w.at(area.s0, area.z0, out_m),
               .a = (area.s1 - area.s0) * w.along,
               .b = (area.z1 - area.z0) * Vec3f::UnitZ(),
               .material = finish.material,
               .facet_m = 0.2f,
               .u0 = area.s0 + 1.7f * unit_float(seed),
               .v0 = area.z0,
               .tint = finish.tint},
              mesh);
  }

  // A box on the wall that stands out by `thick_m`.
  void block(const Wall& w, const Area& area, float thick_m, const Finish& finish) {
    add_box({.centre = w.at(0.5f * (area.s0 + area.s1), 0.5f * (area.z0 + area.z1), 0.5f * thick_m),
             .half = {0.5f * (area.s1 - area.s0) * w.along, 0.5f * thick_m * w.inward,
                      0.5f * (area.z1 - area.z0) * Vec3f::UnitZ()},
             .material = finish.material,
             .facet_m = 0.25f,
             .tint = finish.tint},
            0.0f, seed++, mesh);
  }

  void plain(const Wall& w, float s0, float s1) {
    face(w, {s0, s1, 0.0f, kDado_m}, 0.0f, {kPlaster, 0.62f});
    face(w, {s0, s1, kDado_m, kHeight_m}, 0.0f, {kPlaster, 1.0f});
    if (s1 - s0 < 0.02f) return;
    block(w, {s0, s1, 0.0f, 0.10f}, 0.014f, {kFrame, 0.55f});
    block(w, {s0, s1, kDado_m - 0.02f, kDado_m + 0.02f}, 0.010f, {kFrame, 0.8f});
  }

  void door(const Wall& w, float s0) {
    const float s1 = s0 + kDoorWidth_m;
    const float tint = 0.6f + 0.7f * unit_float(seed * 7u + 1u);
    face(w, {s0, s1, kDoorHeight_m, kHeight_m}, 0.0f, {kPlaster, 1.0f});
    const Vec3f up = kDoorHeight_m * Vec3f::UnitZ();
    add_panel({.origin = w.at(s1, 0.0f, -kRecess_m),  // grain upright
               .a = up,
               .b = -kDoorWidth_m * w.along,
               .material = kDoor,
               .u0 = 3.1f * unit_float(seed),
               .tint = tint},
              mesh);
    const Vec3f deep = -kRecess_m * w.inward;
    // Reveals: the sides and the top of the opening.
    add_panel({.origin = w.at(s0, 0, 0), .a = deep, .b = up, .material = kFrame, .tint = 0.7f},
              mesh);
    add_panel(
        {.origin = w.at(s1, 0, -kRecess_m), .a = -deep, .b = up, .material = kFrame, .tint = 0.7f},
        mesh);
    add_panel({.origin = w.at(s0, kDoorHeight_m, 0),
               .a = deep,
               .b = kDoorWidth_m * w.along,
               .material = kFrame,
               .tint = 0.7f},
              mesh);
    block(w, {s0 - 0.06f, s0, 0.0f, kDoorHeight_m + 0.06f}, 0.025f, {kFrame, 0.75f});
    block(w, {s1, s1 + 0.06f, 0.0f, kDoorHeight_m + 0.06f}, 0.025f, {kFrame, 0.75f});
    block(w, {s0 - 0.06f, s1 + 0.06f, kDoorHeight_m, kDoorHeight_m + 0.06f}, 0.025f,
          {kFrame, 0.75f});
    // Kick plate, handle and a name plate.
    Wall leaf = w;
    leaf.start -= kRecess_m * w.inward;
    block(leaf, {s0 + 0.04f, s1 - 0.04f, 0.03f, 0.24f}, 0.004f, {kMetal, 1.0f});
    block(leaf, {s0 + 0.07f, s0 + 0.20f, 1.03f, 1.06f}, 0.05f, {kMetal, 1.3f});
    block(leaf, {s0 + 0.30f, s0 + 0.62f, 1.48f, 1.60f}, 0.006f, {kPoster, 1.0f});
  }

  // A notice board or a single sheet.
  void poster(const Wall& w, float s0, float width_m) {
    const float low = 0.95f + 0.35f * unit_float(seed * 3u + 2u);
    block(w, {s0 - 0.03f, s0 + width_m + 0.03f, low - 0.03f, low + 0.73f}, 0.012f, {kDoor, 0.7f});
    face(w, {s0, s0 + width_m, low, low + 0.70f}, 0.014f, {kPoster, 1.0f});
  }

  void cabinet(const Wall& w, float s0) {
    block(w, {s0, s0 + 0.36f, 0.72f, 1.42f}, 0.16f, {kMetal, 0.55f});
    block(w, {s0 + 0.05f, s0 + 0.31f, 1.05f, 1.32f}, 0.165f, {kPoster, 0.9f});
  }

  void heater(const Wall& w, float s0) {
    for (int i = 0; i < 9; ++i) {
      const float s = s0 + 0.1f * static_cast<float>(i);
      block(w, {s, s + 0.07f, 0.16f, 0.74f}, 0.09f, {kFrame, 1.25f});
    }
  }

  void furnish(const Wall& w) {
    float done = 0.0f;
    float next = 0.35f + 0.6f * unit_float(hash3(1, 1, 1, seed));
    while (true) {
      const std::uint32_t h = hash3(2, 3, static_cast<int>(100.0f * next), seed);
      const std::uint32_t kind = h % 7u;
      const float width =
          kind < 3u ? kDoorWidth_m : (kind < 5u ? 1.0f : (kind == 5u ? 0.36f : 0.9f));
      if (next + width + 0.3f > w.length_m) break;
      if (kind < 3u) {
        plain(w, done, next);
        door(w, next);
        done = next + width;
      } else if (kind < 5u) {
        poster(w, next, width);
      } else if (kind == 5u) {
        cabinet(w, next);
      } else {
        heater(w, next);
      }
      next += width + 0.35f + 0.9f * unit_float(h * 5u);
    }
    plain(w, done, w.length_m);
  }
};

void add_floor_and_ceiling(const FloorPlan& plan, Mesh& mesh) {
  for (const Room& r : plan.rooms) {
    const Vec3f x = (r.high_x - r.low_x) * Vec3f::UnitX();
    const Vec3f y = (r.high_y - r.low_y) * Vec3f::UnitY();
    add_panel({.origin = {r.low_x, r.low_y, 0.0f},
               .a = x,
               .b = y,
               .material = kTiles,
               .facet_m = 0.2f,
               .u0 = r.low_x,
               .v0 = r.low_y},
              mesh);
    add_panel({.origin = {r.low_x, r.low_y, kHeight_m},
               .a = y,
               .b = x,
               .material = kCeiling,
               .facet_m = 0.2f,
               .u0 = r.low_y,
               .v0 = r.low_x},
              mesh);
  }
}

// Lamps under the ceiling, and a cable tray beside them.
std::vector<Vec3f> add_lamps(const FloorPlan& plan, Mesh& mesh) {
  std::vector<Vec3f> lamps;
  for (std::size_t i = 0; i + 1 < plan.axis.size(); ++i) {
    const Eigen::Vector2f from = plan.axis[i];
    const Eigen::Vector2f d = (plan.axis[i + 1] - from).normalized();
    const float length = (plan.axis[i + 1] - from).norm();
    const Vec3f along(d.x(), d.y(), 0.0f);
    const Vec3f left(-d.y(), d.x(), 0.0f);
    for (float s = 1.5f; s < length - 0.7f; s += kLampSpacing_m) {
      const Vec3f centre(from.x() + s * d.x(), from.y() + s * d.y(), kHeight_m - 0.03f);
      add_box({.centre = centre,
               .half = {0.6f * along, 0.11f * left, 0.03f * Vec3f::UnitZ()},
               .material = kLamp},
              0.0f, 1, mesh);
      lamps.push_back(centre - 0.06f * Vec3f::UnitZ());
    }
    const Vec3f middle(from.x() + 0.5f * length * d.x(), from.y() + 0.5f * length * d.y(),
                       kHeight_m - 0.22f);
    add_box({.centre = middle - 0.95f * left,
             .half = {0.5f * (length - 2.8f) * along, 0.12f * left, 0.035f * Vec3f::UnitZ()},
             .material = kMetal,
             .tint = 0.9f},
            0.0f, 2, mesh);
  }
  return lamps;
}

// Irradiance at a vertex: lamps it sees, and light from all round that is weaker in corners.
float light_at(const FloorPlan& plan, const std::vector<Vec3f>& lamps, const Vertex& vertex) {
  const Vec3f p = vertex.p + 0.12f * vertex.n;  // clear of the wall it lies in
  float light = 0.0f;
  for (const Vec3f& lamp : lamps) {
    const Vec3f to_lamp = lamp - vertex.p;
    const float d2 = to_lamp.squaredNorm();
    if (d2 > 64.0f) continue;
    const float d = std::sqrt(d2);
    const float facing = vertex.n.dot(to_lamp) / d;
    const float leaving = 0.25f + 0.75f * std::max(to_lamp.z() / d, 0.0f);
    if (facing <= 0.0f || !plan.is_open(p, lamp)) continue;
    light += facing * leaving / (d2 + 0.15f);
  }
  int open = 0;
  for (int k = 0; k < 8; ++k) {
    const float angle = 0.7854f * static_cast<float>(k);
    if (plan.is_inside(p.x() + 0.3f * std::cos(angle), p.y() + 0.3f * std::sin(angle))) ++open;
  }
  const float edge = std::min({1.0f, 0.55f + p.z(), 0.7f + (kHeight_m - p.z())});
  return light + 0.22f * (0.4f + 0.6f * static_cast<float>(open) / 8.0f) * edge;
}

}  // namespace

Scene make_corridor(const RoverPath& path, std::uint32_t seed) {
  Scene scene;
  scene.textures.push_back(plaster_surface(seed));
  scene.textures.push_back(tile_surface(seed + 1));
  scene.textures.push_back(ceiling_surface(seed + 2));
  scene.textures.push_back(timber_surface(seed + 3));
  scene.textures.push_back(poster_surface(seed + 4));
  scene.textures.push_back(paint_surface(seed + 5));
  scene.materials = {{.texture = 0},
                     {.texture = 1},
                     {.texture = 2},
                     {.texture = 3},
                     {.texture = 4},
                     {.texture = 5},
                     {.texture = 5, .albedo = 0.8f},
                     {.texture = 5, .albedo = 0.5f, .emission = 1.1f}};
  const FloorPlan plan = make_floor_plan(path);
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    Builder{scene.mesh, hash3(static_cast<int>(i), 0, 0, seed)}.furnish(plan.walls[i]);
  }
  add_floor_and_ceiling(plan, scene.mesh);
  const std::vector<Vec3f> lamps = add_lamps(plan, scene.mesh);
  std::vector<Vertex>& vertices = scene.mesh.vertices;
  for_each_row(static_cast<int>(vertices.size()),
               [&](int i) { vertices[i].light = light_at(plan, lamps, vertices[i]); });
  scene.middle_grey = 0.19f;
  return scene;
}

}  // namespace darkling::synthetic
