// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drivers/injection/pixels.h"
#include "drivers/injection/view.h"

namespace darkling {

namespace {

// The level between four pixels, with the edge repeated outside.
float sample(const ImageView<const std::uint8_t>& image, float x, float y) {
  x = std::clamp(x, 0.0f, static_cast<float>(image.width - 1));
  y = std::clamp(y, 0.0f, static_cast<float>(image.height - 1));
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width - 1);
  const std::uint8_t* above = image.row(y0);
  const std::uint8_t* below = image.row(std::min(y0 + 1, image.height - 1));
  const float u = x - static_cast<float>(x0);
  const float v = y - static_cast<float>(y0);
  const auto between = [u](float a, float b) { return a + u * (b - a); };
  const float a = between(above[x0], above[x1]);
  const float b = between(below[x0], below[x1]);
  return a + v * (b - a);
}

// The right camera turned by `value` about its axis, from x (right) towards y (down): pixel p shows
// what was at c + R(angle) (p − c), c the middle of the image.
class RollRight final : public Injector {
 public:
  explicit RollRight(const Injection& injection)
      : angle_rad_(injection.value * std::numbers::pi / 180.0) {}

  void start(ImageSize size) override {
    straight_.resize(static_cast<std::size_t>(size.width) * size.height);
  }

  FrameFault inject(InjectedPair& pair) override {
    const ImageView<std::uint8_t>& image = pair.right;
    const ImageView<std::uint8_t> straight(straight_.data(), image.width, image.height,
                                           image.width);
    copy_pixels(image, straight);
    const auto cosine = static_cast<float>(std::cos(angle_rad_));
    const auto sine = static_cast<float>(std::sin(angle_rad_));
    const float cx = 0.5f * static_cast<float>(image.width - 1);
    const float cy = 0.5f * static_cast<float>(image.height - 1);
    for (int y = 0; y < image.height; ++y) {
      std::uint8_t* row = image.row(y);
      const float dy = static_cast<float>(y) - cy;
      for (int x = 0; x < image.width; ++x) {
        const float dx = static_cast<float>(x) - cx;
        row[x] =
            to_level(sample(straight, cx + cosine * dx - sine * dy, cy + sine * dx + cosine * dy));
      }
    }
    return FrameFault::kNone;
  }

 private:
  double angle_rad_;
  std::vector<std::uint8_t> straight_;
};

}  // namespace

std::unique_ptr<Injector> make_roll_right(const Injection& injection) {
  return std::make_unique<RollRight>(injection);
}

}  // namespace darkling
