// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace darkling::synthetic {

namespace {

constexpr float kNear_m = 0.05f;
constexpr int kSubpixels = 256;

struct Frustum {
  Eigen::Matrix3f R_camera_scene;
  Eigen::Vector3d p_scene;
  // Inward unit normals of the four sides through the camera's centre, camera frame.
  Vec3f sides[4];

  explicit Frustum(const PinholeView& view)
      : R_camera_scene(view.R_scene_camera.transpose().cast<float>()), p_scene(view.p_scene) {
    const auto left = static_cast<float>((-1.0 - view.cx) / view.focal_px);
    const auto right = static_cast<float>((view.width - view.cx) / view.focal_px);
    const auto top = static_cast<float>((-1.0 - view.cy) / view.focal_px);
    const auto bottom = static_cast<float>((view.height - view.cy) / view.focal_px);
    sides[0] = Vec3f(1, 0, -left).normalized();
    sides[1] = Vec3f(-1, 0, right).normalized();
    sides[2] = Vec3f(0, 1, -top).normalized();
    sides[3] = Vec3f(0, -1, bottom).normalized();
  }

  // Differences in double: the scene may be 200 m long and float would round to 15 µm there.
  [[nodiscard]] Vec3f to_camera(const Vec3f& p) const {
    return R_camera_scene * (p.cast<double>() - p_scene).cast<float>();
  }

  [[nodiscard]] bool may_see(const Chunk& chunk) const {
    const Vec3f centre = to_camera(chunk.centre);
    if (centre.z() < kNear_m - chunk.radius_m) return false;
    for (const Vec3f& side : sides) {
      if (side.dot(centre) < -chunk.radius_m) return false;
    }
    return true;
  }
};

// Twice the signed area of (a, b, p) in 1/256² px²; positive where p is on the inner side.
std::int64_t edge(const ProjectedVertex& a, const ProjectedVertex& b, std::int64_t x,
                  std::int64_t y) {
  return (static_cast<std::int64_t>(b.y) - a.y) * (x - a.x) -
         (static_cast<std::int64_t>(b.x) - a.x) * (y - a.y);
}

class Rasteriser {
 public:
  Rasteriser(const PinholeView& view, VisibilityBuffer& buffer) : view_(view), buffer_(buffer) {}

  void draw(int id, const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c) {
    const int x0 = std::max(ceil_px(std::min({a.x, b.x, c.x})), 0);
    const int x1 = std::min(floor_px(std::max({a.x, b.x, c.x})), view_.width - 1);
    if (x0 > x1) return;
    const int y0 = std::max(ceil_px(std::min({a.y, b.y, c.y})), 0);
    const int y1 = std::min(floor_px(std::max({a.y, b.y, c.y})), view_.height - 1);
    if (y0 > y1 || edge(a, b, c.x, c.y) <= 0) return;  // nothing, or seen from behind
    set_depth_plane(a, b, c);
    const std::int64_t px = static_cast<std::int64_t>(x0) * kSubpixels;
    for (int y = y0; y <= y1; ++y) {
      const std::int64_t py = static_cast<std::int64_t>(y) * kSubpixels;
      std::int64_t w0 = edge(a, b, px, py);
      std::int64_t w1 = edge(b, c, px, py);
      std::int64_t w2 = edge(c, a, px, py);
      const std::size_t row = static_cast<std::size_t>(y) * view_.width;
      for (int x = x0; x <= x1; ++x) {
        if ((w0 | w1 | w2) >= 0) keep_nearest(row + x, id, x, y);
        w0 += (static_cast<std::int64_t>(b.y) - a.y) * kSubpixels;
        w1 += (static_cast<std::int64_t>(c.y) - b.y) * kSubpixels;
        w2 += (static_cast<std::int64_t>(a.y) - c.y) * kSubpixels;
      }
    }
  }

 private:
  static int floor_px(std::int32_t v) { return v >> 8; }
  static int ceil_px(std::int32_t v) { return (v + kSubpixels - 1) >> 8; }

  // 1/z is linear over the image: n·(ray)/(n·a) for the plane through a with normal n.
  void set_depth_plane(const ProjectedVertex& a, const ProjectedVertex& b,
                       const ProjectedVertex& c) {
    const Vec3f n = (b.p_camera - a.p_camera).cross(c.p_camera - a.p_camera);
    const Vec3f m = n / n.dot(a.p_camera);
    const auto per_px = static_cast<float>(1.0 / view_.focal_px);
    dx_ = m.x() * per_px;
    dy_ = m.y() * per_px;
    at_origin_ = m.z() - dx_ * static_cast<float>(view_.cx) - dy_ * static_cast<float>(view_.cy);
    const float za = a.p_camera.z();
    const float zb = b.p_camera.z();
    const float zc = c.p_camera.z();
    lowest_ = 1.0f / std::max({za, zb, zc});
    highest_ = 1.0f / std::min({za, zb, zc});
  }

  void keep_nearest(std::size_t i, int id, int x, int y) {
    float depth = at_origin_ + dx_ * static_cast<float>(x) + dy_ * static_cast<float>(y);
    // A facet seen edge-on has an ill-defined plane, but never leaves the range of its corners.
    if (!(depth >= lowest_)) depth = lowest_;
    if (depth > highest_) depth = highest_;
    if (depth <= buffer_.inverse_depth[i]) return;
    buffer_.inverse_depth[i] = depth;
    buffer_.triangle[i] = id;
  }

  const PinholeView& view_;
  VisibilityBuffer& buffer_;
  float at_origin_ = 0, dx_ = 0, dy_ = 0, lowest_ = 0, highest_ = 0;
};

void project_chunk(const Mesh& mesh, const Chunk& chunk, const PinholeView& view,
                   const Frustum& frustum, std::vector<ProjectedVertex>& projected) {
  projected.resize(chunk.vertex_count);
  const auto focal = static_cast<float>(view.focal_px * kSubpixels);
  const auto cx = static_cast<float>(view.cx * kSubpixels);
  const auto cy = static_cast<float>(view.cy * kSubpixels);
  constexpr float kLimit = 1e8f;  // keeps products of differences within 64 bits
  for (int i = 0; i < chunk.vertex_count; ++i) {
    ProjectedVertex& v = projected[i];
    v.p_camera = frustum.to_camera(mesh.vertices[chunk.first_vertex + i].p);
    v.is_in_front = v.p_camera.z() > kNear_m;
    if (!v.is_in_front) continue;
    const float scale = focal / v.p_camera.z();
    const float x = std::clamp(v.p_camera.x() * scale + cx, -kLimit, kLimit);
    const float y = std::clamp(v.p_camera.y() * scale + cy, -kLimit, kLimit);
    v.x = static_cast<std::int32_t>(std::floor(x + 0.5f));
    v.y = static_cast<std::int32_t>(std::floor(y + 0.5f));
  }
}

}  // namespace

void VisibilityBuffer::resize(int w, int h) {
  width = w;
  height = h;
  triangle.assign(static_cast<std::size_t>(w) * h, -1);
  inverse_depth.assign(static_cast<std::size_t>(w) * h, 0.0f);
}

void find_visible(const Mesh& mesh, const PinholeView& view, VisibilityBuffer& buffer,
                  std::vector<ProjectedVertex>& scratch) {
  buffer.resize(view.width, view.height);
  const Frustum frustum(view);
  Rasteriser rasteriser(view, buffer);
  for (const Chunk& chunk : mesh.chunks) {
    if (!frustum.may_see(chunk)) continue;
    project_chunk(mesh, chunk, view, frustum, scratch);
    for (int i = 0; i < chunk.triangle_count; ++i) {
      const int id = chunk.first_triangle + i;
      const Triangle& t = mesh.triangles[id];
      const ProjectedVertex& a = scratch[t.corner[0] - chunk.first_vertex];
      const ProjectedVertex& b = scratch[t.corner[1] - chunk.first_vertex];
      const ProjectedVertex& c = scratch[t.corner[2] - chunk.first_vertex];
      if (a.is_in_front && b.is_in_front && c.is_in_front) rasteriser.draw(id, a, b, c);
    }
  }
}

}  // namespace darkling::synthetic
