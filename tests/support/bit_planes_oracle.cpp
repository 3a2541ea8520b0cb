// SPDX-License-Identifier: Apache-2.0
#include "support/bit_planes_oracle.h"

#include <algorithm>
#include <cmath>

#include "kernels/bit_planes.h"

namespace darkling::test {

namespace {

constexpr int kPasses = 3;

// The neighbours in the order of their bits.
constexpr int kNeighbours[kPlaneCount][2] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0},
                                             {1, 0},   {-1, 1}, {0, 1},  {1, 1}};

bool has_bit(int code, int c) {
  return (code >> c) % 2 == 1;
}

// One plane, 0, 128 or 255, reaching `margin` pixels beyond the image on every side.
GreyLevels plane_of(const Census& census, int c, int margin) {
  const GreyLevels& brighter = census.brighter;
  GreyLevels plane = {brighter.width + 2 * margin, brighter.height + 2 * margin, {}};
  for (int y = -margin; y < brighter.height + margin; ++y) {
    for (int x = -margin; x < brighter.width + margin; ++x) {
      const bool is_darker = has_bit(census.darker.at(x, y), c);
      plane.levels.push_back(has_bit(brighter.at(x, y), c) ? 255 : is_darker ? 0 : 128);
    }
  }
  return plane;
}

int half_rounded_up(int sum) {
  return sum / 2 + sum % 2;
}

// One pass along (dx, dy), after which the image is two pixels shorter that way.
GreyLevels smoothed_once(const GreyLevels& image, int dx, int dy) {
  GreyLevels out = {image.width - 2 * dx, image.height - 2 * dy, {}};
  for (int y = dy; y < image.height - dy; ++y) {
    for (int x = dx; x < image.width - dx; ++x) {
      const int sides = half_rounded_up(image.at(x - dx, y - dy) + image.at(x + dx, y + dy));
      out.levels.push_back(half_rounded_up(sides + image.at(x, y)));
    }
  }
  return out;
}

}  // namespace

int GreyLevels::at(int x, int y) const {
  const int column = std::clamp(x, 0, width - 1);
  const int row = std::clamp(y, 0, height - 1);
  return levels[static_cast<std::size_t>(row * width + column)];
}

std::vector<std::uint8_t> to_bytes(const GreyLevels& image) {
  std::vector<std::uint8_t> bytes;
  for (const int level : image.levels) bytes.push_back(static_cast<std::uint8_t>(level));
  return bytes;
}

GreyLevels blur_oracle(const ImageView<const std::uint8_t>& grey) {
  GreyLevels blurred = {grey.width, grey.height, {}};
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      double sum = 0.0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const double weight = (i == 0 ? 0.5 : 0.25) * (j == 0 ? 0.5 : 0.25);
          sum += weight * grey.at(std::clamp(x + i, 0, grey.width - 1),
                                  std::clamp(y + j, 0, grey.height - 1));
        }
      }
      blurred.levels.push_back(static_cast<int>(std::floor(sum + 0.5)));
    }
  }
  return blurred;
}

Census census_oracle(const GreyLevels& blurred, int dead_zone) {
  const GreyLevels none = {blurred.width, blurred.height,
                           std::vector<int>(blurred.levels.size(), 0)};
  Census census = {none, none};
  int bit_value = 1;
  for (const auto& [dx, dy] : kNeighbours) {
    for (int i = 0; i < static_cast<int>(none.levels.size()); ++i) {
      const int x = i % none.width;
      const int y = i / none.width;
      const int difference = blurred.at(x + dx, y + dy) - blurred.at(x, y);
      const auto at = static_cast<std::size_t>(i);
      if (difference > dead_zone) census.brighter.levels[at] += bit_value;
      if (difference <= -dead_zone) census.darker.levels[at] += bit_value;
    }
    bit_value *= 2;
  }
  return census;
}

std::vector<std::uint8_t> planes_oracle(const Census& census) {
  std::vector<std::uint8_t> planes(census.brighter.levels.size() * kPlaneCount);
  for (int c = 0; c < kPlaneCount; ++c) {
    GreyLevels plane = plane_of(census, c, kPasses);
    for (int pass = 0; pass < kPasses; ++pass) plane = smoothed_once(plane, 0, 1);
    for (int pass = 0; pass < kPasses; ++pass) plane = smoothed_once(plane, 1, 0);
    for (std::size_t i = 0; i < plane.levels.size(); ++i) {
      planes[i * kPlaneCount + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(plane.levels[i]);
    }
  }
  return planes;
}

std::vector<double> binomial_planes(const Census& census) {
  const GreyLevels& codes = census.brighter;
  constexpr double kTaps[] = {1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0};
  std::vector<double> planes(codes.levels.size() * kPlaneCount, 0.0);
  for (int c = 0; c < kPlaneCount; ++c) {
    const GreyLevels plane = plane_of(census, c, kPasses);
    for (int i = 0; i < static_cast<int>(codes.levels.size()); ++i) {
      double sum = 0.0;
      for (int k = 0; k < 49; ++k) {
        sum += kTaps[k / 7] * kTaps[k % 7] *
               plane.at(i % codes.width + k % 7, i / codes.width + k / 7);
      }
      planes[static_cast<std::size_t>(i * kPlaneCount + c)] = sum / 4096.0;
    }
  }
  return planes;
}

}  // namespace darkling::test
