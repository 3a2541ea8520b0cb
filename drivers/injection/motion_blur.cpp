// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drivers/injection/pixels.h"
#include "drivers/injection/view.h"

namespace darkling {

namespace {

// Every pixel becomes the mean of `value` pixels in a line through it, one pixel apart and rounded
// to whole ones, with the edge repeated outside. The line is horizontal in frame 0 and turns by a
// half in 120 frames. Sums of at most 64 levels fit 16 bits: 64 · 255 = 16320.
class MotionBlur final : public Injector {
 public:
  explicit MotionBlur(const Injection& injection)
      : taps_(static_cast<int>(injection.value)), margin_(taps_ / 2 + 1) {}

  void start(ImageSize size) override {
    width_ = size.width + 2 * margin_;
    padded_.resize(static_cast<std::size_t>(width_) * (size.height + 2 * margin_));
    sums_.resize(static_cast<std::size_t>(size.width));
  }

  FrameFault inject(InjectedPair& pair) override {
    constexpr std::int64_t kHalfTurn = 120;  // frames
    const double angle = std::numbers::pi * static_cast<double>(pair.sequence % kHalfTurn) /
                         static_cast<double>(kHalfTurn);
    blur(angle, pair.left);
    blur(angle, pair.right);
    return FrameFault::kNone;
  }

 private:
  void pad(const ImageView<const std::uint8_t>& image) {
    const int height = image.height + 2 * margin_;
    for (int y = 0; y < height; ++y) {
      const std::uint8_t* from = image.row(std::clamp(y - margin_, 0, image.height - 1));
      std::uint8_t* to = padded_.data() + static_cast<std::size_t>(y) * width_;
      std::fill_n(to, margin_, from[0]);
      std::copy_n(from, image.width, to + margin_);
      std::fill_n(to + margin_ + image.width, margin_, from[image.width - 1]);
    }
  }

  void blur(double angle, const ImageView<std::uint8_t>& image) {
    pad(image);
    const float share = 1.0f / static_cast<float>(taps_);
    for (int y = 0; y < image.height; ++y) {
      std::fill(sums_.begin(), sums_.end(), std::uint16_t{0});
      for (int tap = 0; tap < taps_; ++tap) {
        const double along_px = tap - 0.5 * (taps_ - 1);
        const auto dx = static_cast<int>(std::lround(along_px * std::cos(angle)));
        const auto dy = static_cast<int>(std::lround(along_px * std::sin(angle)));
        const std::uint8_t* from =
            padded_.data() + static_cast<std::ptrdiff_t>(y + dy + margin_) * width_ + dx + margin_;
        for (std::size_t x = 0; x < sums_.size(); ++x) {
          sums_[x] = static_cast<std::uint16_t>(sums_[x] + from[x]);
        }
      }
      std::uint8_t* row = image.row(y);
      for (std::size_t x = 0; x < sums_.size(); ++x) {
        row[x] = to_level(share * static_cast<float>(sums_[x]));
      }
    }
  }

  int taps_;
  int margin_;                        // px on every side of the padded image
  int width_ = 0;                     // of the padded image, px
  std::vector<std::uint8_t> padded_;  // one eye
  std::vector<std::uint16_t> sums_;   // one row
};

}  // namespace

std::unique_ptr<Injector> make_blur(const Injection& injection) {
  return std::make_unique<MotionBlur>(injection);
}

}  // namespace darkling
