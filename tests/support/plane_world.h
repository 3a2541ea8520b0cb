// SPDX-License-Identifier: Apache-2.0
// A wall and a floor with smooth textures, seen by an ideal rectified camera: the truth about depth
// and motion is exact, and nothing depends on the renderer that the product carries.
#pragma once

#include "base/image_view.h"
#include "geometry/se3.h"
#include "geometry/stereo_rig.h"
#include "support/smooth_texture.h"

namespace darkling::test {

// 160x120, 120 px focal length, 0.2 m baseline, Body = Left.
[[nodiscard]] RectifiedRig ideal_rig();

// World: x right, y down, z forward, as the camera that stands at the identity.
class PlaneWorld {
 public:
  struct Layout {
    double wall_z_m = 6.0;
    double wall_slope = 0.0;  // how much further the wall is, a metre to the right
    double floor_y_m = 1.2;   // below the camera; infinity: there is no floor
    std::uint64_t seed = 1;
  };
  PlaneWorld() : PlaneWorld(Layout()) {}
  explicit PlaneWorld(const Layout& layout);

  // Distance along the axis to what the pixel (u, v) sees, m.
  [[nodiscard]] double depth_m(const RectifiedRig& rig, const Se3& T_world_camera, double u,
                               double v) const;
  // What the camera sees, every pixel the mean of four rays.
  void render(const RectifiedRig& rig, const Se3& T_world_camera,
              ImageView<std::uint8_t> image) const;

 private:
  struct Hit {
    double depth_m;
    double level;
  };
  [[nodiscard]] Hit look(const RectifiedRig& rig, const Se3& T_world_camera, double u,
                         double v) const;

  Layout layout_;
  SmoothTexture wall_;
  SmoothTexture floor_;
};

}  // namespace darkling::test
