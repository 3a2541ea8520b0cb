// SPDX-License-Identifier: Apache-2.0
// Injections that treat every pixel of a level alike.
#include <array>
#include <cmath>

#include "drivers/injection/light.h"
#include "drivers/injection/pixels.h"

namespace darkling {

namespace {

void multiply(double factor, InjectedPair& pair) {
  LevelMap map;
  for (std::size_t v = 0; v < map.size(); ++v) {
    map[v] = to_level(static_cast<float>(factor) * static_cast<float>(v));
  }
  map_levels(map, pair.left);
  map_levels(map, pair.right);
}

using Histogram = std::array<std::int64_t, 256>;

void count_levels(const ImageView<const std::uint8_t>& image, Histogram& histogram) {
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width; ++x) ++histogram[row[x]];
  }
}

// The highest level that `share` of all pixels reach; at least 1.
int level_reached_by(double share, const Histogram& histogram) {
  std::int64_t total = 0;
  for (const std::int64_t count : histogram) total += count;
  const double wanted = share * static_cast<double>(total);
  std::int64_t reached = 0;
  int level = 256;
  do {
    --level;
    reached += histogram[static_cast<std::size_t>(level)];
  } while (level > 1 && static_cast<double>(reached) < wanted);
  return level;
}

}  // namespace

void apply_gain(const Injection& injection, InjectedPair& pair) {
  multiply(injection.value, pair);
}

void apply_gamma(const Injection& injection, InjectedPair& pair) {
  LevelMap map;
  for (std::size_t v = 0; v < map.size(); ++v) {
    const double share = std::pow(static_cast<double>(v) / 255.0, injection.value);
    map[v] = to_level(static_cast<float>(255.0 * share));
  }
  map_levels(map, pair.left);
  map_levels(map, pair.right);
}

// Up or down by a coin rather than in turn: with every second frame left out, it flickers still.
void apply_flicker(const Injection& injection, InjectedPair& pair) {
  const bool is_up = (noise_key(injection, pair.sequence, kBothEyes) & 1u) != 0;
  multiply(is_up ? 1.0 + injection.value : 1.0 - injection.value, pair);
}

void apply_saturate(const Injection& injection, InjectedPair& pair) {
  Histogram histogram = {};
  count_levels(pair.left, histogram);
  count_levels(pair.right, histogram);
  multiply(255.0 / level_reached_by(injection.value, histogram), pair);
}

}  // namespace darkling
