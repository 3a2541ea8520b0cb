// SPDX-License-Identifier: Apache-2.0
#include "drivers/sensor/photon_noise.h"

#include <cmath>

#include <gtest/gtest.h>

#include "drivers/sensor/mix64.h"

namespace darkling {
namespace {

// P(count = k), by another road than adding up: logarithms.
double poisson(double mean, int k) {
  return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
}

TEST(PoissonTable, HasTheDistributionItIsNamedFor) {
  PoissonTable table;
  constexpr int kDraws = 200000;
  for (const double mean : {0.05, 1.0, 7.3, 39.9}) {
    table.set_mean(17, mean);
    std::array<int, 128> seen = {};
    for (std::uint64_t i = 0; i < kDraws; ++i) {
      ++seen.at(static_cast<std::size_t>(table.draw(17, static_cast<std::uint32_t>(mix64(i)))));
    }
    for (int k = 0; k < 128; ++k) {
      const double p = poisson(mean, k);
      const double sigma = std::sqrt(p * (1.0 - p) / kDraws);
      EXPECT_NEAR(seen[static_cast<std::size_t>(k)] / static_cast<double>(kDraws), p,
                  5.0 * sigma + 1.0 / kDraws)
          << k << " of " << mean;
    }
  }
}

TEST(PoissonTable, CountsNothingWithoutLightAndEndsWhateverTheBits) {
  PoissonTable table;
  table.set_mean(0, 0.0);
  table.set_mean(255, 39.999);
  EXPECT_EQ(table.draw(0, 0u), 0);
  EXPECT_EQ(table.draw(0, 0xfffffffeu), 0);
  EXPECT_LE(table.draw(255, 0xffffffffu), 127);
  EXPECT_LT(table.draw(255, 0u), 12);
}

TEST(PoissonTable, AgreesWithTheCountThatIsAddedUp) {
  PoissonTable table;
  table.set_mean(3, 12.5);
  int different = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const std::uint64_t random = mix64(i);
    const auto added = static_cast<int>(draw_poisson(12.5f, random));
    different += table.draw(3, static_cast<std::uint32_t>(random >> 32)) == added ? 0 : 1;
  }
  EXPECT_LE(different, 2) << "where the last bits of the sum decide";
}

TEST(NormalQuantiles, HaveMeanZeroAndVarianceOne) {
  const NormalQuantiles& normal = NormalQuantiles::get();
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  for (std::uint64_t i = 0; i < 4096; ++i) {
    const double x = normal(i << 52);
    sum += x / 4096;
    squares += x * x / 4096;
    fourth += x * x * x * x / 4096;
  }
  EXPECT_NEAR(sum, 0.0, 1e-6);
  EXPECT_NEAR(squares, 1.0, 1e-5);
  EXPECT_NEAR(fourth, 3.0, 0.05);
}

}  // namespace
}  // namespace darkling
