// SPDX-License-Identifier: Apache-2.0
// Whole images as values, to compare and to print.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "base/image_view.h"
#include "support/guarded_image.h"
#include "support/kernel_cases.h"

namespace darkling::test {

// Row by row, without padding.
template <class T>
[[nodiscard]] std::vector<std::remove_const_t<T>> pixels_of(const ImageView<T>& image) {
  std::vector<std::remove_const_t<T>> pixels;
  for (int y = 0; y < image.height; ++y) {
    pixels.insert(pixels.end(), image.row(y), image.row(y) + image.width);
  }
  return pixels;
}

[[nodiscard]] inline std::string describe(const GuardedLayout& layout) {
  std::ostringstream text;
  text << layout.width << "x" << layout.height << ", row padding " << layout.row_padding
       << ", distance to guard " << layout.distance_to_guard
       << (layout.guard == GuardSide::kBehindLastRow ? " behind" : " before");
  return text.str();
}

[[nodiscard]] inline std::string describe(const GuardedLayout& layout, Fill fill) {
  return describe(layout) + ", fill " + name_of(fill);
}

// The same place in memory with another width and height.
[[nodiscard]] inline GuardedLayout resized(GuardedLayout layout, int width, int height) {
  layout.width = width;
  layout.height = height;
  return layout;
}

// Half up, as the kernels round; exact for what doubles hold exactly.
[[nodiscard]] inline double round_half_up(double value) {
  return std::floor(value + 0.5);
}

}  // namespace darkling::test
