// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "drivers/sensor/photon_noise.h"
#include "drivers/synthetic/synthetic_spec.h"

namespace darkling::synthetic {

// The level that mid-grey is recorded as with the default exposure and gain, above black.
inline constexpr double kMiddleLevel = 125.0;

// An image sensor with linear response and an 8-bit converter.
struct Sensor {
  double electrons_per_grey = 4000.0;  // collected from radiance `middle grey` in this exposure
  double levels_per_electron = 0.03;   // after the amplifier
  double read_noise_e = 8.0;           // standard deviation
};

// The sensor with the exposure and gain that `spec` asks for.
[[nodiscard]] Sensor make_sensor(const SyntheticSpec& spec);

// Exposes one row.
//
//   level = black + levels_per_electron · (Poisson(electrons) + Normal(0, read_noise)),
//
// rounded to the nearest and clipped to 0…255.
//
// @param light  radiance over middle grey, lens losses included.
// @param key    chooses the noise: the same key and pixel, the same noise.
void expose(const Sensor& sensor, std::span<const float> light, std::uint64_t key,
            std::span<std::uint8_t> levels);

}  // namespace darkling::synthetic
