// SPDX-License-Identifier: Apache-2.0
// Deterministic randomness for the synthetic scenes: integer hashes, and noise fields built on
// them. The same arguments give the same value on every run and thread.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "drivers/sensor/mix64.h"

namespace darkling::synthetic {

using Vec3f = Eigen::Vector3f;

[[nodiscard]] constexpr std::uint32_t scramble(std::uint32_t h) {
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}

[[nodiscard]] constexpr std::uint32_t hash3(int x, int y, int z, std::uint32_t seed) {
  return scramble(seed * 0x9e3779b1u + static_cast<std::uint32_t>(x) * 0x85ebca77u +
                  static_cast<std::uint32_t>(y) * 0xc2b2ae3du +
                  static_cast<std::uint32_t>(z) * 0x27d4eb2fu);
}

[[nodiscard]] inline float lerp(float a, float b, float t) {
  return a + (b - a) * t;
}
// 0 below `low`, 1 above `high`, smooth between.
[[nodiscard]] float smooth_step(float low, float high, float x);

// Gradient noise of about [-1, 1] with features of size 1.
[[nodiscard]] float gradient_noise(const Vec3f& p, std::uint32_t seed);
// Octaves of gradient_noise, each half the size and `persistence` times the height of the last.
[[nodiscard]] float fractal_noise(const Vec3f& p, int octaves, float persistence,
                                  std::uint32_t seed);

// Fractal noise on the unit square that wraps round at its edges; the first octave has `period`
// features across.
[[nodiscard]] float tiling_noise(float u, float v, int period, int octaves, float persistence,
                                 std::uint32_t seed);

// Where a point lies among scattered seeds, one a cell: what stones and cracks are made of.
struct Cell {
  float nearest = 0.0f;  // distance to the nearest seed, in cells
  float second = 0.0f;   // distance to the second nearest
  std::uint32_t id = 0;  // hash of the nearest seed
};
// On the unit square, wrapping, `period` cells across.
[[nodiscard]] Cell tiling_cells(float u, float v, int period, std::uint32_t seed);

}  // namespace darkling::synthetic
