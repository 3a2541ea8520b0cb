// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/injection/light.h"
#include "drivers/injection/pixels.h"
#include "drivers/sensor/mix64.h"
#include "drivers/sensor/photon_noise.h"

namespace darkling {

namespace {

constexpr float kReadNoise_e = 1.0f;  // standard deviation: a good camera's

// Takes the grey level for the light, lets the pair's mean level be `value` photo-electrons, and
// amplifies what was counted until that mean is back:
//
//   level' = black + (mean level / N) · (Poisson(level · N / mean level) + Normal(0, 1 e)),
//
// rounded to the nearest and clipped. The mean is one of both eyes: they share their exposure. The
// source's own black level and noise count as light.
class Electrons final : public Injector {
 public:
  explicit Electrons(const Injection& injection) : injection_(injection) {}

  void start(ImageSize /*size*/) override { electrons_per_level_ = 0.0; }

  FrameFault inject(InjectedPair& pair) override {
    const double mean = std::max(0.5 * (mean_level(pair.left) + mean_level(pair.right)), 1.0);
    set_exposure(injection_.value / mean);
    expose(pair.left, noise_key(injection_, pair.sequence, kLeftEye));
    expose(pair.right, noise_key(injection_, pair.sequence, kRightEye));
    return FrameFault::kNone;
  }

 private:
  struct Level {
    float electrons = 0.0f;  // on average
    float sigma_e = 0.0f;    // of light and reading; 0: the count is drawn from the table
  };

  void set_exposure(double electrons_per_level) {
    if (electrons_per_level == electrons_per_level_) return;
    electrons_per_level_ = electrons_per_level;
    for (int v = 0; v < PoissonTable::kMeanCount; ++v) {
      const double mean = v * electrons_per_level;
      const bool is_table = mean < kNormalFromElectrons;
      if (is_table) poisson_.set_mean(v, mean);
      const double sigma_e = is_table ? 0.0 : std::sqrt(mean + kReadNoise_e * kReadNoise_e);
      levels_[v] = {.electrons = static_cast<float>(mean), .sigma_e = static_cast<float>(sigma_e)};
    }
  }

  void expose(const ImageView<std::uint8_t>& image, std::uint64_t key) const {
    const auto gain = static_cast<float>(1.0 / electrons_per_level_);
    for (int y = 0; y < image.height; ++y) {
      std::uint8_t* row = image.row(y);
      const std::uint64_t row_key = key + static_cast<std::uint64_t>(y) * image.width;
      for (int x = 0; x < image.width; ++x) {
        const float electrons = collect(row[x], mix64(row_key + static_cast<std::uint64_t>(x)));
        row[x] = to_level(static_cast<float>(kBlackLevel) + gain * electrons);
      }
    }
  }

  [[nodiscard]] float collect(std::uint8_t v, std::uint64_t random) const {
    const Level& level = levels_[v];
    if (level.sigma_e > 0.0f) return level.electrons + level.sigma_e * normal_(random);
    const int count = poisson_.draw(v, static_cast<std::uint32_t>(random >> 32));
    return static_cast<float>(count) + kReadNoise_e * normal_(random << 32);
  }

  Injection injection_;
  double electrons_per_level_ = 0.0;  // that the tables are for
  std::array<Level, PoissonTable::kMeanCount> levels_;
  PoissonTable poisson_;
  const NormalQuantiles& normal_ = NormalQuantiles::get();
};

}  // namespace

std::unique_ptr<Injector> make_electrons(const Injection& injection) {
  return std::make_unique<Electrons>(injection);
}

}  // namespace darkling
