// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/surfaces.h"

#include <algorithm>
#include <cmath>

#include "drivers/synthetic/parallel.h"

namespace darkling::synthetic {

namespace {

struct Spot {
  float albedo = 0.5f;
  float height_m = 0.0f;
};

// @param recipe  (u, v) in [0, 1) → Spot; must wrap round.
template <class Recipe>
Texture make_texture(int size, float extent_m, const Recipe& recipe) {
  std::vector<float> albedo(static_cast<std::size_t>(size) * size);
  std::vector<float> height_m(albedo.size());
  for_each_row(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const Spot spot = recipe((static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(size));
      const std::size_t i = static_cast<std::size_t>(y) * size + x;
      albedo[i] = std::clamp(spot.albedo, 0.02f, 1.0f);
      height_m[i] = spot.height_m;
    }
  });
  return Texture(size, extent_m, albedo, height_m);
}

// 1 along the zero lines of a noise, 0 away from them.
float vein(float noise, float width) {
  return 1.0f - smooth_step(0.0f, width, std::abs(noise));
}

// 0 at the joint of a grid of `count` squares, 1 inside.
float inside_joint(float x, float width) {
  const float f = x - std::floor(x);
  return smooth_step(0.0f, width, std::min(f, 1.0f - f));
}

// A layer of stones: adds to height and overwrites albedo where a stone lies.
struct Stones {
  int period;     // cells across a repetition
  float share;    // of cells that hold a stone
  float pitch_m;  // of a cell
  std::uint32_t seed;
};

void add_stones(float u, float v, const Stones& stones, Spot& spot) {
  const Cell cell = tiling_cells(u, v, stones.period, stones.seed);
  if (unit_float(cell.id ^ 0x5bd1e995u) > stones.share) return;
  const float size = 0.28f + 0.25f * unit_float(cell.id * 3u);
  const float edge = 0.5f * (cell.second - cell.nearest);
  const float dome = std::min(1.0f - cell.nearest / size, 2.5f * edge);
  if (dome <= 0.0f) return;
  spot.height_m += 0.30f * stones.pitch_m * std::sqrt(std::min(dome * 1.6f, 1.0f));
  const float shade = 0.22f + 0.5f * unit_float(cell.id * 7u);
  spot.albedo = lerp(spot.albedo, shade, smooth_step(0.0f, 0.12f, dome));
}

}  // namespace

Texture rock_surface(std::uint32_t seed) {
  return make_texture(1024, 3.0f, [seed](float u, float v) {
    const float mottle = tiling_noise(u, v, 5, 7, 0.64f, seed);
    const float warp_u = u + 0.02f * tiling_noise(u, v, 13, 2, 0.5f, seed + 20);
    const float warp_v = v + 0.02f * tiling_noise(u, v, 13, 2, 0.5f, seed + 30);
    const Cell block = tiling_cells(warp_u, warp_v, 9, seed + 40);
    const Cell chip = tiling_cells(warp_u, warp_v, 40, seed + 41);
    const float crack = 1.0f - smooth_step(0.0f, 0.06f, block.second - block.nearest);
    const float fine_crack = 1.0f - smooth_step(0.0f, 0.10f, chip.second - chip.nearest);
    const float quartz = vein(tiling_noise(u, v, 4, 5, 0.6f, seed + 50), 0.03f) *
                         smooth_step(0.0f, 0.6f, tiling_noise(u, v, 3, 1, 0.5f, seed + 51));
    Spot spot;
    spot.albedo = 0.42f + 0.17f * mottle + 0.09f * (unit_float(block.id) - 0.5f) +
                  0.06f * (unit_float(chip.id) - 0.5f) + 0.22f * quartz;
    const float open = smooth_step(-0.2f, 0.5f, tiling_noise(u, v, 6, 2, 0.5f, seed + 60));
    spot.albedo *= (1.0f - 0.45f * open * crack) * (1.0f - 0.25f * open * fine_crack);
    spot.height_m = 0.016f * mottle - 0.008f * open * crack - 0.002f * open * fine_crack +
                    0.010f * open * (unit_float(block.id) - 0.5f);
    return spot;
  });
}

Texture gravel_surface(std::uint32_t seed) {
  return make_texture(1024, 3.0f, [seed](float u, float v) {
    const float dust = tiling_noise(u, v, 4, 7, 0.62f, seed);
    Spot spot{0.36f + 0.13f * dust, 0.006f * dust};
    add_stones(u, v, {190, 0.5f, 3.0f / 190, seed + 1}, spot);
    add_stones(u, v, {83, 0.32f, 3.0f / 83, seed + 2}, spot);
    add_stones(u, v, {31, 0.16f, 3.0f / 31, seed + 3}, spot);
    spot.albedo *= 1.0f + 0.25f * tiling_noise(u, v, 170, 2, 0.5f, seed + 9);
    return spot;
  });
}

Texture timber_surface(std::uint32_t seed) {
  return make_texture(512, 1.0f, [seed](float u, float v) {
    const float bend = 0.03f * tiling_noise(u, v, 2, 3, 0.5f, seed);
    const float grain = tiling_noise(u, 6.0f * (v + bend), 4, 6, 0.7f, seed + 1);
    const float stain = tiling_noise(u, v, 3, 4, 0.5f, seed + 2);
    const float split = vein(tiling_noise(u, 5.0f * (v + bend), 3, 3, 0.5f, seed + 3), 0.04f);
    return Spot{(0.42f + 0.16f * grain + 0.12f * stain) * (1.0f - 0.5f * split),
                0.002f * grain - 0.003f * split};
  });
}

Texture cloud_surface(std::uint32_t seed) {
  return make_texture(512, 6.0f, [seed](float u, float v) {
    return Spot{smooth_step(-0.25f, 0.6f, tiling_noise(u, v, 4, 7, 0.55f, seed)), 0.0f};
  });
}

Texture plaster_surface(std::uint32_t seed) {
  return make_texture(1024, 3.0f, [seed](float u, float v) {
    const float stain = tiling_noise(u, v, 3, 5, 0.5f, seed);
    const float roller = tiling_noise(u, v, 90, 3, 0.7f, seed + 1);
    const float scuff = vein(tiling_noise(u, 3.0f * v, 3, 5, 0.6f, seed + 2), 0.02f) *
                        smooth_step(0.05f, 0.5f, tiling_noise(u, v, 5, 3, 0.5f, seed + 3));
    const Cell chip = tiling_cells(u, v, 37, seed + 4);
    const float hole =
        unit_float(chip.id) < 0.08f ? 1.0f - smooth_step(0.05f, 0.12f, chip.nearest) : 0.0f;
    const float crack = vein(tiling_noise(u, v, 3, 7, 0.55f, seed + 5), 0.006f);
    return Spot{0.62f * (1.0f + 0.07f * stain + 0.06f * roller) * (1.0f - 0.35f * scuff) *
                    (1.0f - 0.6f * hole) * (1.0f - 0.25f * crack),
                0.0f};
  });
}

Texture tile_surface(std::uint32_t seed) {
  return make_texture(1024, 2.4f, [seed](float u, float v) {
    const int column = static_cast<int>(8.0f * u);
    const int row = static_cast<int>(8.0f * v);
    const float tile = unit_float(hash3(column, row, 0, seed)) - 0.5f;
    const float joint = inside_joint(8.0f * u, 0.02f) * inside_joint(8.0f * v, 0.02f);
    const float wear = tiling_noise(u, v, 3, 6, 0.55f, seed + 1);
    Spot spot{0.40f + 0.09f * tile + 0.05f * wear, 0.0f};
    const Cell chip = tiling_cells(u, v, 110, seed + 2);
    if (unit_float(chip.id * 5u) < 0.45f && chip.nearest < 0.38f) {
      spot.albedo += 0.30f * (unit_float(chip.id) - 0.5f);
    }
    spot.albedo *= 0.35f + 0.65f * joint;
    return spot;
  });
}

Texture ceiling_surface(std::uint32_t seed) {
  return make_texture(1024, 2.4f, [seed](float u, float v) {
    const float joint = inside_joint(4.0f * u, 0.018f) * inside_joint(4.0f * v, 0.018f);
    const Cell pin = tiling_cells(u, v, 120, seed);
    const float hole =
        unit_float(pin.id) < 0.6f ? 1.0f - smooth_step(0.1f, 0.25f, pin.nearest) : 0.0f;
    const float stain = tiling_noise(u, v, 3, 5, 0.5f, seed + 1);
    return Spot{(0.72f + 0.05f * stain) * (1.0f - 0.35f * hole) * (0.5f + 0.5f * joint), 0.0f};
  });
}

Texture poster_surface(std::uint32_t seed) {
  return make_texture(512, 1.0f, [seed](float u, float v) {
    // Sheets on a grid of 4 × 3, each turned into print or a picture by its hash.
    const float column = std::floor(4.0f * u);
    const float row = std::floor(3.0f * v);
    const float s = 4.0f * u - column;
    const float t = 3.0f * v - row;
    const std::uint32_t id = hash3(static_cast<int>(column), static_cast<int>(row), 3, seed);
    const float margin = 0.05f + 0.08f * unit_float(id);
    const float cork = 0.30f + 0.10f * tiling_noise(u, v, 60, 3, 0.7f, seed + 7);
    if (std::min({s, 1.0f - s, t, 1.0f - t}) < margin) return Spot{cork, 0.0f};
    if ((id & 3u) == 0u) {
      return Spot{0.45f + 0.45f * tiling_noise(u, v, 9, 6, 0.6f, seed + (id & 255u)), 0.0f};
    }
    const float line = 22.0f * t;
    const int word = static_cast<int>(26.0f * s);
    const bool is_ink = line - std::floor(line) < 0.5f && s > 0.18f && s < 0.84f && t > 0.15f &&
                        t < 0.86f && (hash3(word, static_cast<int>(line), 5, id) & 3u) != 0u;
    return Spot{is_ink ? 0.18f : 0.78f + 0.1f * (unit_float(id * 9u) - 0.5f), 0.0f};
  });
}

Texture paint_surface(std::uint32_t seed) {
  return make_texture(512, 1.6f, [seed](float u, float v) {
    const float wear = tiling_noise(u, v, 4, 7, 0.6f, seed);
    const float scratch = vein(tiling_noise(3.0f * u, v, 3, 4, 0.5f, seed + 1), 0.012f);
    return Spot{0.5f * (1.0f + 0.08f * wear) * (1.0f + 0.3f * scratch), 0.0f};
  });
}

}  // namespace darkling::synthetic
