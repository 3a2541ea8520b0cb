// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "drivers/synthetic/noise.h"

namespace darkling::synthetic {

// A corner of the surface, in the scene's frame (x, y level, z up; m).
struct Vertex {
  Vec3f p = Vec3f::Zero();
  Vec3f n = Vec3f::UnitZ();  // smooth normal, unit
  float u = 0.0f;            // place on the material, m
  float v = 0.0f;
  float tint = 1.0f;       // multiplies the albedo: variation too large for a repeating texture
  float light = 0.0f;      // irradiance that does not move: sky, lamps on the ceiling
  float shadow_m = -1.0f;  // how far below the edge of the sun's shadow; negative = in the sun
};

// A facet with what shading needs precomputed. Seen from its front, corners run anticlockwise.
struct Triangle {
  std::array<std::int32_t, 3> corner = {};
  std::int32_t material = 0;
  Vec3f n = Vec3f::UnitZ();      // facet normal, unit
  Vec3f dual_1 = Vec3f::Zero();  // (p - corner 0)·dual_k is the barycentric weight of corner k
  Vec3f dual_2 = Vec3f::Zero();
};

// Neighbouring triangles with their own run of vertices, culled together.
struct Chunk {
  std::int32_t first_triangle = 0;
  std::int32_t triangle_count = 0;
  std::int32_t first_vertex = 0;
  std::int32_t vertex_count = 0;
  Vec3f centre = Vec3f::Zero();
  float radius_m = 0.0f;
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Chunk> chunks;
};

// A rectangular net of vertices, `rows` × `columns`. Facets face the side from which rows run up
// and columns run right.
struct VertexGrid {
  int rows = 0;
  int columns = 0;
  std::vector<Vertex> vertices;

  VertexGrid(int rows_, int columns_)
      : rows(rows_), columns(columns_), vertices(static_cast<std::size_t>(rows_) * columns_) {}
  [[nodiscard]] Vertex& at(int row, int column) {
    return vertices[static_cast<std::size_t>(row) * columns + column];
  }
  [[nodiscard]] const Vertex& at(int row, int column) const {
    return vertices[static_cast<std::size_t>(row) * columns + column];
  }
};

// Fills in smooth normals from the positions. `is_ring`: the last column repeats the first.
void set_smooth_normals(VertexGrid& grid, bool is_ring);

// Appends the net's facets; `material_of(row, column)` names the material of each quad.
void add_grid(const VertexGrid& grid, const std::function<int(int, int)>& material_of, Mesh& mesh);

// A box given by its centre, half edges (not necessarily along the axes, but at right angles and
// right-handed) and material; (u, v) in m on every side. `facet_m` is the largest facet edge.
struct Box {
  Vec3f centre = Vec3f::Zero();
  std::array<Vec3f, 3> half = {};
  int material = 0;
  float facet_m = 0.3f;
  float tint = 1.0f;
};
// @param roughness_m  corners are moved at random by about this much.
void add_box(const Box& box, float roughness_m, std::uint32_t seed, Mesh& mesh);

// Appends the rectangle origin + a·[0,1] + b·[0,1], seen from the side of a × b.
struct Panel {
  Vec3f origin = Vec3f::Zero();
  Vec3f a = Vec3f::Zero();
  Vec3f b = Vec3f::Zero();
  int material = 0;
  float facet_m = 0.25f;
  float u0 = 0.0f;  // (u, v) at the origin, m
  float v0 = 0.0f;
  float tint = 1.0f;
};
void add_panel(const Panel& panel, Mesh& mesh);

}  // namespace darkling::synthetic
