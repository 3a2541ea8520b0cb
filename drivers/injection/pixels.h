// SPDX-License-Identifier: Apache-2.0
// What several injections do with whole images.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// The nearest grey level. Not by std::clamp(), which branches: where noise decides, that took half
// as long again.
[[nodiscard]] inline std::uint8_t to_level(float value) {
  return static_cast<std::uint8_t>(std::min(std::max(value + 0.5f, 0.0f), 255.0f));
}

using LevelMap = std::array<std::uint8_t, 256>;

inline void map_levels(const LevelMap& map, const ImageView<std::uint8_t>& image) {
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width; ++x) row[x] = map[row[x]];
  }
}

[[nodiscard]] inline double mean_level(const ImageView<const std::uint8_t>& image) {
  std::int64_t sum = 0;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width; ++x) sum += row[x];
  }
  return static_cast<double>(sum) / (static_cast<double>(image.width) * image.height);
}

// @pre of the same size.
inline void copy_pixels(const ImageView<const std::uint8_t>& from,
                        const ImageView<std::uint8_t>& to) {
  for (int y = 0; y < from.height; ++y) std::copy_n(from.row(y), from.width, to.row(y));
}

inline void fill_pixels(std::uint8_t level, const ImageView<std::uint8_t>& image) {
  for (int y = 0; y < image.height; ++y) std::fill_n(image.row(y), image.width, level);
}

}  // namespace darkling
