// SPDX-License-Identifier: Apache-2.0
// The four steps of bit_planes, each by itself on whole images, written from the contract.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.h"

namespace darkling::test {

// An image of whole numbers, row by row, without padding.
struct GreyLevels {
  int width = 0;
  int height = 0;
  std::vector<int> levels;

  // Beyond the border the nearest pixel stands in.
  [[nodiscard]] int at(int x, int y) const;
};

// What fits bytes.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const GreyLevels& image);

// Step 1, in doubles and so exact, rounded half up afterwards.
[[nodiscard]] GreyLevels blur_oracle(const ImageView<const std::uint8_t>& grey);

// Both codes of every pixel.
struct Census {
  GreyLevels brighter;
  GreyLevels darker;
};

// Step 2, one neighbour at a time, of an image that is blurred already.
[[nodiscard]] Census census_oracle(const GreyLevels& blurred, int dead_zone);

// Steps 3 and 4: interleaved planes, each line smoothed alone.
[[nodiscard]] std::vector<std::uint8_t> planes_oracle(const Census& census);

// The same with the binomial filter of order 6 in doubles, which nothing rounds.
[[nodiscard]] std::vector<double> binomial_planes(const Census& census);

}  // namespace darkling::test
