// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/scene.h"

#include "drivers/synthetic/quarry_ground.h"

namespace darkling::synthetic {

namespace {

std::uint32_t scene_seed(const SyntheticSpec& spec) {
  return static_cast<std::uint32_t>(mix64(spec.seed) >> 32);
}

}  // namespace

RoverPath make_path(const SyntheticSpec& spec) {
  WayShape shape;
  double bump_scale = 1.0;
  if (spec.scene == "corridor") {
    shape.is_square = true;
    shape.correction_deg = 3.0;
    shape.lead_m = 1.5;
    bump_scale = 0.25;  // joints of tiles, not stones
  }
  RoverPath path(shape,
                 {.duration_s = (spec.frames - 1) / spec.rate_hz,
                  .speed_mps = spec.speed,
                  .bump_scale = bump_scale},
                 mix64(spec.seed));
  if (spec.scene == "quarry") {
    path.set_ground([seed = scene_seed(spec)](double x_m, double y_m) {
      return static_cast<double>(
          quarry_ground(static_cast<float>(x_m), static_cast<float>(y_m), seed));
    });
  }
  return path;
}

Scene make_scene(const SyntheticSpec& spec, const RoverPath& path) {
  if (spec.scene == "quarry") return make_quarry(path, scene_seed(spec));
  if (spec.scene == "corridor") return make_corridor(path, scene_seed(spec));
  return make_mine(path, scene_seed(spec));
}

}  // namespace darkling::synthetic
