// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/synthetic/sensor.h"

namespace darkling::synthetic {
namespace {

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments expose_flat(const Sensor& sensor, float light, std::uint64_t key = 1) {
  const std::vector<float> row(100000, light);
  std::vector<std::uint8_t> levels(row.size());
  expose(sensor, row, key, levels);
  Moments m;
  for (std::uint8_t level : levels) m.mean += level;
  m.mean /= static_cast<double>(levels.size());
  for (std::uint8_t level : levels) m.variance += (level - m.mean) * (level - m.mean);
  m.variance /= static_cast<double>(levels.size());
  return m;
}

// Photon transfer: variance = gain² (electrons + read noise²) + 1/12 of rounding.
TEST(Sensor, HasTheNoiseOfItsPhotonsAndItsAmplifier) {
  for (const double electrons : {20.0, 35.0, 60.0, 400.0}) {
    const Sensor sensor{.electrons_per_grey = electrons,
                        .levels_per_electron = 100.0 / electrons,
                        .read_noise_e = 3.0};
    for (const float light : {0.5f, 1.0f}) {
      const double n = electrons * light;
      const double gain = sensor.levels_per_electron;
      const Moments m = expose_flat(sensor, light);
      const double variance = gain * gain * (n + 9.0) + 1.0 / 12.0;
      // Ten electrons at a gain of ten are now and then cut off at black; hence the slack.
      const double slack = n < 20.0 ? 0.06 : 0.02;
      EXPECT_NEAR(m.mean, kBlackLevel + gain * n, 1.5 * slack * gain * std::sqrt(n + 9.0) + 0.02)
          << n;
      EXPECT_NEAR(m.variance / variance, 1.0, n < 20.0 ? 0.12 : 0.03) << n;
    }
  }
}

TEST(Sensor, IsLinearInLight) {
  const Sensor sensor{.electrons_per_grey = 20000, .levels_per_electron = 0.005, .read_noise_e = 0};
  EXPECT_NEAR(expose_flat(sensor, 0.5f).mean, kBlackLevel + 50, 0.05);
  EXPECT_NEAR(expose_flat(sensor, 1.0f).mean, kBlackLevel + 100, 0.05);
  EXPECT_NEAR(expose_flat(sensor, 2.0f).mean, kBlackLevel + 200, 0.05);
}

TEST(Sensor, ClipsAtWhite) {
  EXPECT_EQ(expose_flat({}, 100.0f).mean, 255.0);
  EXPECT_EQ(expose_flat({}, 100.0f).variance, 0.0);
}

TEST(Sensor, RepeatsItsNoiseForTheSameKeyOnly) {
  const std::vector<float> row(64, 1.0f);
  std::vector<std::uint8_t> a(64), b(64), c(64);
  expose({}, row, 5, a);
  expose({}, row, 5, b);
  expose({}, row, 123456, c);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
}

}  // namespace
}  // namespace darkling::synthetic
