// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.h"

namespace darkling::test {

// Grey levels on the endless plane, known everywhere: a sum of plane waves without direction, so
// that values and means over any box are exact.
class SmoothTexture {
 public:
  struct Waves {
    int count = 40;
    double min_length = 3.0;  // wavelength, in the units of the plane
    double max_length = 30.0;
    double deviation = 50.0;  // standard deviation of the grey levels about 128
    std::uint64_t seed = 1;
  };
  explicit SmoothTexture(const Waves& waves);

  // The mean over the box of `size` about (x, y); 0 is the value itself. Not clamped to 0…255.
  [[nodiscard]] double mean(double x, double y, double size) const;

 private:
  struct Wave {
    double kx;
    double ky;
    double phase;
  };
  std::vector<Wave> waves_;
  double amplitude_ = 0.0;
};

// A grey level as a camera would store it: rounded and kept within 0…255.
[[nodiscard]] std::uint8_t to_grey(double level);

// Fills every pixel with `level(x, y)`.
template <class Level>
void paint(ImageView<std::uint8_t> image, const Level& level) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) image.at(x, y) = to_grey(level(x, y));
  }
}

}  // namespace darkling::test
