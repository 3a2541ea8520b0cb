// SPDX-License-Identifier: Apache-2.0
#include "support/plane_world.h"

#include <limits>

#include "support/example_rigs.h"

namespace darkling::test {

RectifiedRig ideal_rig() {
  RectifiedRig rig;
  rig.width = 160;
  rig.height = 120;
  rig.focal_px = 120.0;
  rig.cx = 79.5;
  rig.cy = 59.5;
  rig.baseline_m = 0.2;
  return rig;
}

// Waves from 4 to 40 px on the wall, where 120 px of focal length see it from 6 m; longer ones on
// the floor, where a row is up to 0.25 m deep.
PlaneWorld::PlaneWorld(const Layout& layout)
    : layout_(layout),
      wall_({.min_length = 0.2, .max_length = 2.0, .seed = layout.seed}),
      floor_({.min_length = 0.5, .max_length = 3.0, .seed = layout.seed + 1000}) {}

PlaneWorld::Hit PlaneWorld::look(const RectifiedRig& rig, const Se3& T_world_camera, double u,
                                 double v) const {
  const Vector3 ray = T_world_camera.rotation() * rectified_ray(rig, u, v);
  const Vector3& origin = T_world_camera.translation();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  // z = wall_z + slope · x on the wall; the ray's own length is the depth, as its z is 1.
  const double wall = (layout_.wall_z_m + layout_.wall_slope * origin.x() - origin.z()) /
                      (ray.z() - layout_.wall_slope * ray.x());
  const double floor = ray.y() > 0.0 ? (layout_.floor_y_m - origin.y()) / ray.y() : kFar;
  const bool is_floor = floor < wall;
  const double depth_m = is_floor ? floor : wall;
  const Vector3 p = origin + depth_m * ray;
  return {depth_m, is_floor ? floor_.mean(p.x(), p.z(), 0.0) : wall_.mean(p.x(), p.y(), 0.0)};
}

double PlaneWorld::depth_m(const RectifiedRig& rig, const Se3& T_world_camera, double u,
                           double v) const {
  return look(rig, T_world_camera, u, v).depth_m;
}

void PlaneWorld::render(const RectifiedRig& rig, const Se3& T_world_camera,
                        ImageView<std::uint8_t> image) const {
  paint(image, [&](int x, int y) {
    double sum = 0.0;
    for (const double dy : {-0.25, 0.25}) {
      for (const double dx : {-0.25, 0.25}) {
        sum += look(rig, T_world_camera, x + dx, y + dy).level;
      }
    }
    return 0.25 * sum;
  });
}

}  // namespace darkling::test
