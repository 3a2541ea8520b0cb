// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "drivers/synthetic/noise.h"

namespace darkling::synthetic {

namespace {

constexpr int kQuantiles = 4096;
// Above this mean a Poisson count is drawn as a rounded normal: skewness 1/√λ is below 0.16.
constexpr double kNormalFromElectrons = 40.0;

// Φ⁻¹ at the middles of kQuantiles equal slices, by bisection of erf, scaled to unit variance.
std::array<float, kQuantiles> make_normal_quantiles() {
  std::array<float, kQuantiles> q{};
  double variance = 0.0;
  for (int i = 0; i < kQuantiles; ++i) {
    const double p = (i + 0.5) / kQuantiles;
    double low = -6.0;
    double high = 6.0;
    for (int k = 0; k < 48; ++k) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle * 0.70710678118654752) < p ? low : high) = middle;
    }
    q[i] = static_cast<float>(low);
    variance += low * low / kQuantiles;
  }
  for (float& x : q) x /= static_cast<float>(std::sqrt(variance));
  return q;
}

float normal(std::uint64_t bits) {
  static const std::array<float, kQuantiles> kTable = make_normal_quantiles();
  return kTable[static_cast<std::size_t>(bits >> 52)];
}

// Poisson counts by adding up the distribution until it passes a uniform number.
float small_poisson(float mean, std::uint64_t bits) {
  const float uniform = unit_float(static_cast<std::uint32_t>(bits >> 32));
  float p = std::exp(-mean);
  float sum = p;
  float count = 0.0f;
  while (sum < uniform && count < 150.0f) {
    count += 1.0f;
    p *= mean / count;
    sum += p;
  }
  return count;
}

}  // namespace

Sensor make_sensor(const SyntheticSpec& spec) {
  const double longer = spec.exposure_ms / SyntheticSpec{}.exposure_ms;
  return {.electrons_per_grey = spec.electrons * longer,
          .levels_per_electron = spec.gain * kMiddleLevel / spec.electrons,
          .read_noise_e = spec.read_noise_e};
}

void expose(const Sensor& sensor, std::span<const float> light, std::uint64_t key,
            std::span<std::uint8_t> levels) {
  CHECK(light.size() == levels.size(), "one level a pixel");
  const auto scale = static_cast<float>(sensor.electrons_per_grey);
  const auto gain = static_cast<float>(sensor.levels_per_electron);
  const auto read_noise = static_cast<float>(sensor.read_noise_e);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const std::uint64_t random = mix64(key + i);
    const float mean = std::max(light[i], 0.0f) * scale;
    float electrons;
    if (mean >= static_cast<float>(kNormalFromElectrons)) {
      electrons = mean + std::sqrt(mean + read_noise * read_noise) * normal(random);
    } else {
      electrons = small_poisson(mean, random) + read_noise * normal(mix64(random));
    }
    const float level = static_cast<float>(kBlackLevel) + gain * electrons + 0.5f;
    levels[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f));
  }
}

}  // namespace darkling::synthetic
