// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/synthetic/mesh.h"
#include "drivers/synthetic/rover_path.h"
#include "drivers/synthetic/synthetic_spec.h"
#include "drivers/synthetic/texture.h"

namespace darkling::synthetic {

// What a facet is made of.
struct Material {
  int texture = 0;
  float albedo = 1.0f;    // multiplies the texture's
  float relief = 1.0f;    // multiplies the texture's slopes
  float emission = 0.0f;  // radiance of its own
};

// The sun: parallel light, with shadows precomputed at the vertices.
struct Sun {
  Vec3f direction = Vec3f::UnitZ();  // towards it, unit
  float irradiance = 0.0f;           // on a surface that faces it; 0 = no sun
};

// A lamp that rides on the rover, at a point of Body: a spot with fall-off by the square of the
// distance, so what it lights changes as it moves.
struct Headlamp {
  Vec3f p_body = Vec3f::Zero();
  Vec3f axis_body = Vec3f::UnitX();
  float intensity = 0.0f;  // irradiance at 1 m on the axis; 0 = no lamp
};

struct Sky {
  float zenith = 0.0f;  // radiance
  float horizon = 0.0f;
  int cloud_texture = -1;
};

// Everything there is to see. Radiance is relative: see `middle_grey`.
// Reflection is Lambert's: the same from wherever it is seen.
struct Scene {
  Mesh mesh;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  Sun sun;
  Headlamp headlamp;
  Sky sky;
  float haze_per_m = 0.0f;   // extinction by dust; what is lost is replaced by the horizon's light
  float middle_grey = 1.0f;  // radiance that a camera at its defaults records as level 128
};

// Each scene lays its way and then builds what stands along it.
[[nodiscard]] RoverPath make_path(const SyntheticSpec& spec);
[[nodiscard]] Scene make_scene(const SyntheticSpec& spec, const RoverPath& path);

// @pre the path is that of the same scene.
[[nodiscard]] Scene make_mine(const RoverPath& path, std::uint32_t seed);
[[nodiscard]] Scene make_quarry(const RoverPath& path, std::uint32_t seed);
[[nodiscard]] Scene make_corridor(const RoverPath& path, std::uint32_t seed);

}  // namespace darkling::synthetic
