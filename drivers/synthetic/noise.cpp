// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/noise.h"

#include <algorithm>
#include <cmath>

namespace darkling::synthetic {

namespace {

float fade(float t) {
  return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// @pre -period <= i < 2 · period.
int wrap(int i, int period) {
  return i < 0 ? i + period : (i >= period ? i - period : i);
}

// The dot product of (x, y, z) with one of the twelve edge directions of a cube.
float edge_gradient(std::uint32_t h, float x, float y, float z) {
  const std::uint32_t k = h & 15u;
  const float a = k < 8u ? x : y;
  const float b = k < 4u ? y : (k == 12u || k == 14u ? x : z);
  return ((k & 1u) != 0u ? -a : a) + ((k & 2u) != 0u ? -b : b);
}

// The dot product of (x, y) with a direction taken from the hash; lengths up to √2.
float plane_gradient(std::uint32_t h, float x, float y) {
  const auto gx = static_cast<float>(static_cast<int>(h & 0xffffu) - 0x8000);
  const auto gy = static_cast<float>(static_cast<int>(h >> 16) - 0x8000);
  return (gx * x + gy * y) * (1.6f / 32768.0f);
}

// One octave of wrapping gradient noise; `period` lattice cells across the unit square.
// @pre 0 <= u, v <= 1.
float tiling_octave(float u, float v, int period, std::uint32_t seed) {
  const float x = u * static_cast<float>(period);
  const float y = v * static_cast<float>(period);
  const int ix = static_cast<int>(x);
  const int iy = static_cast<int>(y);
  const int x0 = wrap(ix, period);
  const int y0 = wrap(iy, period);
  const int x1 = wrap(x0 + 1, period);
  const int y1 = wrap(y0 + 1, period);
  const float dx = x - static_cast<float>(ix);
  const float dy = y - static_cast<float>(iy);
  // hash3() for z = 0, its sums shared between the four corners.
  const std::uint32_t hx0 = seed * 0x9e3779b1u + static_cast<std::uint32_t>(x0) * 0x85ebca77u;
  const std::uint32_t hx1 = seed * 0x9e3779b1u + static_cast<std::uint32_t>(x1) * 0x85ebca77u;
  const std::uint32_t hy0 = static_cast<std::uint32_t>(y0) * 0xc2b2ae3du;
  const std::uint32_t hy1 = static_cast<std::uint32_t>(y1) * 0xc2b2ae3du;
  const float a = plane_gradient(scramble(hx0 + hy0), dx, dy);
  const float b = plane_gradient(scramble(hx1 + hy0), dx - 1.0f, dy);
  const float c = plane_gradient(scramble(hx0 + hy1), dx, dy - 1.0f);
  const float d = plane_gradient(scramble(hx1 + hy1), dx - 1.0f, dy - 1.0f);
  const float s = fade(dx);
  return lerp(lerp(a, b, s), lerp(c, d, s), fade(dy));
}

}  // namespace

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

float gradient_noise(const Vec3f& p, std::uint32_t seed) {
  const Vec3f base(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
  const Vec3f d = p - base;
  const int x = static_cast<int>(base.x());
  const int y = static_cast<int>(base.y());
  const int z = static_cast<int>(base.z());
  const float s = fade(d.x());
  const float t = fade(d.y());
  float planes[2];
  for (int k = 0; k < 2; ++k) {
    const float dz = d.z() - static_cast<float>(k);
    const float a = edge_gradient(hash3(x, y, z + k, seed), d.x(), d.y(), dz);
    const float b = edge_gradient(hash3(x + 1, y, z + k, seed), d.x() - 1.0f, d.y(), dz);
    const float c = edge_gradient(hash3(x, y + 1, z + k, seed), d.x(), d.y() - 1.0f, dz);
    const float e = edge_gradient(hash3(x + 1, y + 1, z + k, seed), d.x() - 1.0f, d.y() - 1.0f, dz);
    planes[k] = lerp(lerp(a, b, s), lerp(c, e, s), t);
  }
  return lerp(planes[0], planes[1], fade(d.z()));
}

float fractal_noise(const Vec3f& p, int octaves, float persistence, std::uint32_t seed) {
  float sum = 0.0f;
  float height = 1.0f;
  Vec3f q = p;
  for (int i = 0; i < octaves; ++i) {
    sum += height * gradient_noise(q, seed + static_cast<std::uint32_t>(i));
    height *= persistence;
    q *= 2.0f;
  }
  return sum;
}

float tiling_noise(float u, float v, int period, int octaves, float persistence,
                   std::uint32_t seed) {
  u -= std::floor(u);
  v -= std::floor(v);
  float sum = 0.0f;
  float height = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += height * tiling_octave(u, v, period << i, seed + static_cast<std::uint32_t>(i));
    height *= persistence;
  }
  return sum;
}

Cell tiling_cells(float u, float v, int period, std::uint32_t seed) {
  const float x = (u - std::floor(u)) * static_cast<float>(period);
  const float y = (v - std::floor(v)) * static_cast<float>(period);
  const int cx = static_cast<int>(std::floor(x));
  const int cy = static_cast<int>(std::floor(y));
  float nearest = 1e9f;
  float second = 1e9f;
  std::uint32_t id = 0;
  for (int j = cy - 1; j <= cy + 1; ++j) {
    for (int i = cx - 1; i <= cx + 1; ++i) {
      const std::uint32_t h = hash3(wrap(i, period), wrap(j, period), 7, seed);
      const float dx = static_cast<float>(i) + unit_float(h) - x;
      const float dy = static_cast<float>(j) + unit_float(h * 0x9e3779b1u) - y;
      const float d = dx * dx + dy * dy;
      if (d < nearest) {
        second = nearest;
        nearest = d;
        id = h;
      } else {
        second = std::min(second, d);
      }
    }
  }
  return {std::sqrt(nearest), std::sqrt(second), id};
}

}  // namespace darkling::synthetic
