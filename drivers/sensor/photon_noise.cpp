// SPDX-License-Identifier: Apache-2.0
#include "drivers/sensor/photon_noise.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "drivers/sensor/mix64.h"

namespace darkling {

// Φ⁻¹ at the middles of kCount equal slices, by bisection of erf, scaled to unit variance.
NormalQuantiles::NormalQuantiles() {
  double variance = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double p = (i + 0.5) / kCount;
    double low = -6.0;
    double high = 6.0;
    for (int k = 0; k < 48; ++k) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle * 0.70710678118654752) < p ? low : high) = middle;
    }
    quantiles_[i] = static_cast<float>(low);
    variance += low * low / kCount;
  }
  for (float& x : quantiles_) x /= static_cast<float>(std::sqrt(variance));
}

const NormalQuantiles& NormalQuantiles::get() {
  static const NormalQuantiles kQuantiles;
  return kQuantiles;
}

float draw_poisson(float mean, std::uint64_t bits) {
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

void PoissonTable::set_mean(int index, double mean) {
  CHECK(mean >= 0.0 && mean < kNormalFromElectrons, "the table ends beyond the highest mean");
  Sums& sums = sums_.at(static_cast<std::size_t>(index));
  sums.fill(~std::uint32_t{0});
  double p = std::exp(-mean);
  double sum = p;
  // Until what is left is below the unit: further on, p is denormal and takes ten times as long.
  for (int k = 0; k < kMostCount && (p > 1e-12 || k < mean); ++k) {
    sums[k] = static_cast<std::uint32_t>(std::min(sum * 0x1p32, 0x1p32 - 1.0));
    p *= mean / (k + 1);
    sum += p;
  }
  Starts& starts = starts_.at(static_cast<std::size_t>(index));
  std::uint8_t count = 0;
  for (std::uint32_t slice = 0; slice < starts.size(); ++slice) {
    while (slice << 24 > sums[count]) ++count;
    starts[slice] = count;
  }
}

}  // namespace darkling
