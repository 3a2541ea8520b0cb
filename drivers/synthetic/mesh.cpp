// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/mesh.h"

#include <algorithm>
#include <cmath>

namespace darkling::synthetic {

namespace {

constexpr int kChunkQuads = 16;

// Everything but the corners and the material follows from where the corners are.
void set_plane(const std::vector<Vertex>& vertices, Triangle& triangle) {
  const Vec3f& p = vertices[triangle.corner[0]].p;
  const Vec3f e1 = vertices[triangle.corner[1]].p - p;
  const Vec3f e2 = vertices[triangle.corner[2]].p - p;
  const Vec3f normal = e1.cross(e2);
  const float area2 = std::max(normal.norm(), 1e-12f);
  triangle.n = normal / area2;
  triangle.dual_1 = e2.cross(triangle.n) / area2;
  triangle.dual_2 = triangle.n.cross(e1) / area2;
}

void add_triangle(int a, int b, int c, int material, Mesh& mesh) {
  Triangle triangle;
  triangle.corner = {a, b, c};
  triangle.material = material;
  set_plane(mesh.vertices, triangle);
  mesh.triangles.push_back(triangle);
}

void close_chunk(Chunk chunk, Mesh& mesh) {
  chunk.triangle_count = static_cast<int>(mesh.triangles.size()) - chunk.first_triangle;
  chunk.vertex_count = static_cast<int>(mesh.vertices.size()) - chunk.first_vertex;
  Vec3f low = mesh.vertices[chunk.first_vertex].p;
  Vec3f high = low;
  for (int i = 0; i < chunk.vertex_count; ++i) {
    low = low.cwiseMin(mesh.vertices[chunk.first_vertex + i].p);
    high = high.cwiseMax(mesh.vertices[chunk.first_vertex + i].p);
  }
  chunk.centre = 0.5f * (low + high);
  chunk.radius_m = 0.5f * (high - low).norm();
  mesh.chunks.push_back(chunk);
}

// The quads [row, row_end) × [column, column_end) of the net as one chunk.
struct Block {
  int row, row_end, column, column_end;
};

void add_block(const VertexGrid& grid, const Block& block,
               const std::function<int(int, int)>& material_of, Mesh& mesh) {
  Chunk chunk;
  chunk.first_triangle = static_cast<int>(mesh.triangles.size());
  chunk.first_vertex = static_cast<int>(mesh.vertices.size());
  const int width = block.column_end - block.column + 1;
  for (int r = block.row; r <= block.row_end; ++r) {
    for (int c = block.column; c <= block.column_end; ++c) mesh.vertices.push_back(grid.at(r, c));
  }
  for (int r = block.row; r < block.row_end; ++r) {
    for (int c = block.column; c < block.column_end; ++c) {
      const int i = chunk.first_vertex + (r - block.row) * width + (c - block.column);
      const int material = material_of(r, c);
      add_triangle(i, i + 1, i + width + 1, material, mesh);
      add_triangle(i, i + width + 1, i + width, material, mesh);
    }
  }
  close_chunk(chunk, mesh);
}

}  // namespace

void set_smooth_normals(VertexGrid& grid, bool is_ring) {
  const int last = grid.columns - 1;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      int left = std::max(c - 1, 0);
      int right = std::min(c + 1, last);
      if (is_ring && (c == 0 || c == last)) {
        left = last - 1;
        right = 1;
      }
      const Vec3f along = grid.at(r, right).p - grid.at(r, left).p;
      const Vec3f up =
          grid.at(std::min(r + 1, grid.rows - 1), c).p - grid.at(std::max(r - 1, 0), c).p;
      grid.at(r, c).n = along.cross(up).normalized();
    }
  }
}

void add_grid(const VertexGrid& grid, const std::function<int(int, int)>& material_of, Mesh& mesh) {
  for (int r = 0; r + 1 < grid.rows; r += kChunkQuads) {
    for (int c = 0; c + 1 < grid.columns; c += kChunkQuads) {
      add_block(grid,
                {r, std::min(r + kChunkQuads, grid.rows - 1), c,
                 std::min(c + kChunkQuads, grid.columns - 1)},
                material_of, mesh);
    }
  }
}

void add_panel(const Panel& panel, Mesh& mesh) {
  const float a_m = panel.a.norm();
  const float b_m = panel.b.norm();
  const int columns = std::max(1, static_cast<int>(std::ceil(a_m / panel.facet_m)));
  const int rows = std::max(1, static_cast<int>(std::ceil(b_m / panel.facet_m)));
  VertexGrid grid(rows + 1, columns + 1);
  const Vec3f normal = panel.a.cross(panel.b).normalized();
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      const float s = static_cast<float>(c) / static_cast<float>(columns);
      const float t = static_cast<float>(r) / static_cast<float>(rows);
      Vertex& vertex = grid.at(r, c);
      vertex.p = panel.origin + s * panel.a + t * panel.b;
      vertex.n = normal;
      vertex.u = panel.u0 + s * a_m;
      vertex.v = panel.v0 + t * b_m;
      vertex.tint = panel.tint;
    }
  }
  add_grid(
      grid, [&](int, int) { return panel.material; }, mesh);
}

void add_box(const Box& box, float roughness_m, std::uint32_t seed, Mesh& mesh) {
  const std::size_t first_vertex = mesh.vertices.size();
  const std::size_t first_triangle = mesh.triangles.size();
  const std::size_t first_chunk = mesh.chunks.size();
  for (int side = 0; side < 6; ++side) {
    const int k = side / 2;
    const float sign = side % 2 == 0 ? 1.0f : -1.0f;
    const Vec3f& normal = box.half[k];
    // Longest edge along u, so that grain runs along a beam.
    Vec3f a = box.half[(k + 1) % 3];
    Vec3f b = box.half[(k + 2) % 3];
    if (a.norm() < b.norm()) std::swap(a, b);
    if (a.cross(b).dot(normal) * sign < 0.0f) b = -b;
    add_panel({.origin = box.centre + sign * normal - a - b,
               .a = 2.0f * a,
               .b = 2.0f * b,
               .material = box.material,
               .facet_m = box.facet_m,
               .u0 = 0.37f * static_cast<float>(side) + unit_float(seed),
               .v0 = 0.23f * static_cast<float>(side),
               .tint = box.tint},
              mesh);
  }
  if (roughness_m <= 0.0f) return;
  // By position, so that sides move together where they meet.
  for (std::size_t i = first_vertex; i < mesh.vertices.size(); ++i) {
    Vec3f& p = mesh.vertices[i].p;
    const Vec3f q = 4.0f * p;
    p += roughness_m *
         Vec3f(gradient_noise(q, seed), gradient_noise(q, seed + 1), gradient_noise(q, seed + 2));
  }
  for (std::size_t i = first_triangle; i < mesh.triangles.size(); ++i) {
    set_plane(mesh.vertices, mesh.triangles[i]);
  }
  for (std::size_t i = first_chunk; i < mesh.chunks.size(); ++i) {
    mesh.chunks[i].radius_m += 2.0f * roughness_m;
  }
}

}  // namespace darkling::synthetic
