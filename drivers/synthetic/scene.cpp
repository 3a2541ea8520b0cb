// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/scene.h"

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
    shape.beyond_m = 16.0;
    bump_scale = 0.25;  // joints of tiles, not stones
  }
  return RoverPath(shape,
                   {.duration_s = (spec.frames - 1) / spec.rate_hz,
                    .speed_mps = spec.speed,
                    .bump_scale = bump_scale},
                   mix64(spec.seed));
}

Scene make_scene(const SyntheticSpec& spec, const RoverPath& path) {
  if (spec.scene == "quarry") return make_quarry(path, scene_seed(spec));
  if (spec.scene == "corridor") return make_corridor(path, scene_seed(spec));
  return make_mine(path, scene_seed(spec));
}

}  // namespace darkling::synthetic
