// SPDX-License-Identifier: Apache-2.0
// Injections that make some places of the image brighter or darker than others.
#include <algorithm>
#include <cmath>
#include <vector>

#include "drivers/injection/light.h"
#include "drivers/injection/pixels.h"
#include "drivers/injection/wander.h"

namespace darkling {

namespace {

// light · (1 + strength · exp(−d²/2σ²)) around a spot that wanders, at the same place in both eyes.
class Lamp final : public Injector {
 public:
  explicit Lamp(const Injection& injection) : injection_(injection) {}

  void start(ImageSize size) override {
    columns_.resize(static_cast<std::size_t>(size.width));
    rows_.resize(static_cast<std::size_t>(size.height));
  }

  FrameFault inject(InjectedPair& pair) override {
    constexpr double kReach = 0.8;  // of the way from the middle to the edges
    const WanderedTo place = wander(injection_, pair.sequence);
    const double sigma_px = 0.15 * pair.left.width;
    fall_off(0.5 * (1.0 + kReach * place.x) * pair.left.width, sigma_px, columns_);
    fall_off(0.5 * (1.0 + kReach * place.y) * pair.left.height, sigma_px, rows_);
    brighten(pair.left);
    brighten(pair.right);
    return FrameFault::kNone;
  }

 private:
  static void fall_off(double centre_px, double sigma_px, std::vector<float>& weights) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double d = (static_cast<double>(i) - centre_px) / sigma_px;
      weights[i] = static_cast<float>(std::exp(-0.5 * d * d));
    }
  }

  void brighten(const ImageView<std::uint8_t>& image) const {
    for (int y = 0; y < image.height; ++y) {
      std::uint8_t* row = image.row(y);
      const float peak = static_cast<float>(injection_.value) * rows_[static_cast<std::size_t>(y)];
      for (int x = 0; x < image.width; ++x) {
        const float factor = 1.0f + peak * columns_[static_cast<std::size_t>(x)];
        row[x] = to_level(factor * static_cast<float>(row[x]));
      }
    }
  }

  Injection injection_;
  std::vector<float> columns_;  // the spot is their product
  std::vector<float> rows_;
};

// light · (1 − share · r²), r the distance from the middle over that of the corners.
class Vignette final : public Injector {
 public:
  explicit Vignette(const Injection& injection) : share_(injection.value) {}

  void start(ImageSize size) override {
    const double r_corner_2 = 0.25 * (size.width * size.width + size.height * size.height);
    darken(size.width, r_corner_2, columns_);
    darken(size.height, r_corner_2, rows_);
  }

  FrameFault inject(InjectedPair& pair) override {
    for (const ImageView<std::uint8_t>& image : {pair.left, pair.right}) {
      for (int y = 0; y < image.height; ++y) {
        std::uint8_t* row = image.row(y);
        const float left_over = 1.0f - rows_[static_cast<std::size_t>(y)];
        for (int x = 0; x < image.width; ++x) {
          const float factor = left_over - columns_[static_cast<std::size_t>(x)];
          row[x] = to_level(factor * static_cast<float>(row[x]));
        }
      }
    }
    return FrameFault::kNone;
  }

 private:
  void darken(int count, double r_corner_2, std::vector<float>& shares) const {
    shares.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const double d = i - 0.5 * (count - 1);
      shares[static_cast<std::size_t>(i)] = static_cast<float>(share_ * d * d / r_corner_2);
    }
  }

  double share_;
  std::vector<float> columns_;  // what is lost is their sum
  std::vector<float> rows_;
};

}  // namespace

std::unique_ptr<Injector> make_lamp(const Injection& injection) {
  return std::make_unique<Lamp>(injection);
}

std::unique_ptr<Injector> make_vignette(const Injection& injection) {
  return std::make_unique<Vignette>(injection);
}

}  // namespace darkling
