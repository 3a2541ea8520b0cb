// SPDX-License-Identifier: Apache-2.0
#include "support/smooth_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/random.h"

namespace darkling::test {

namespace {

// How much of a wave of wave number `k` is left after a mean over `size`.
double kept_by_mean(double k, double size) {
  const double half = 0.5 * k * size;
  return std::abs(half) < 1e-9 ? 1.0 : std::sin(half) / half;
}

}  // namespace

SmoothTexture::SmoothTexture(const Waves& waves)
    : amplitude_(waves.deviation * std::sqrt(2.0 / waves.count)) {
  Random random(waves.seed);
  for (int i = 0; i < waves.count; ++i) {
    const double share = (i + 0.5) / waves.count;
    const double length = waves.min_length * std::pow(waves.max_length / waves.min_length, share);
    const double k = 2.0 * std::numbers::pi / length;
    const double direction = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    waves_.push_back({k * std::cos(direction), k * std::sin(direction), phase});
  }
}

double SmoothTexture::mean(double x, double y, double size) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum += kept_by_mean(wave.kx, size) * kept_by_mean(wave.ky, size) *
           std::cos(wave.kx * x + wave.ky * y + wave.phase);
  }
  return 128.0 + amplitude_ * sum;
}

std::uint8_t to_grey(double level) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(level + 0.5), 0.0, 255.0));
}

}  // namespace darkling::test
