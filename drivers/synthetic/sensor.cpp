// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/sensor.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "drivers/sensor/mix64.h"

namespace darkling::synthetic {

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
  const NormalQuantiles& normal = NormalQuantiles::get();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const std::uint64_t random = mix64(key + i);
    const float mean = std::max(light[i], 0.0f) * scale;
    float electrons;
    if (mean >= static_cast<float>(kNormalFromElectrons)) {
      electrons = mean + std::sqrt(mean + read_noise * read_noise) * normal(random);
    } else {
      electrons = draw_poisson(mean, random) + read_noise * normal(mix64(random));
    }
    const float level = static_cast<float>(kBlackLevel) + gain * electrons + 0.5f;
    levels[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f));
  }
}

}  // namespace darkling::synthetic
