// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "app/bench/roofline.h"

namespace darkling {
namespace {

constexpr MachineSpeed kSpeed = {
    .bytes_per_ns = 100.0, .byte_operations_per_ns = 200.0, .float_operations_per_ns = 50.0};

TEST(Roofline, IsTheLongerOfMemoryAndArithmetic) {
  const Roofline streaming =
      roofline({.bytes = 1000.0, .byte_operations = 200.0, .float_operations = 50.0}, kSpeed);
  EXPECT_DOUBLE_EQ(streaming.memory_ns, 10.0);
  EXPECT_DOUBLE_EQ(streaming.arithmetic_ns, 2.0);  // one after the other, bytes and floats
  EXPECT_TRUE(streaming.is_memory_bound());
  EXPECT_DOUBLE_EQ(streaming.bound_ns(), 10.0);

  const Roofline computing = roofline({.bytes = 100.0, .byte_operations = 4000.0}, kSpeed);
  EXPECT_FALSE(computing.is_memory_bound());
  EXPECT_DOUBLE_EQ(computing.bound_ns(), 20.0);
}

TEST(Roofline, AddsUpWithWhatIsDoneAfterIt) {
  Roofline sum = {.memory_ns = 3.0, .arithmetic_ns = 1.0};
  sum += {.memory_ns = 1.0, .arithmetic_ns = 5.0};
  EXPECT_DOUBLE_EQ(sum.memory_ns, 4.0);
  EXPECT_DOUBLE_EQ(sum.bound_ns(), 6.0);
}

TEST(PowerLaw, IsFoundWhereItIsExact) {
  const std::vector<double> x = {10.0, 20.0, 50.0, 400.0};
  std::vector<double> y;
  for (const double value : x) y.push_back(3.0 * std::pow(value, 0.8));
  const PowerLaw law = fit_power_law(x, y);
  EXPECT_NEAR(law.exponent, 0.8, 1e-12);
  EXPECT_NEAR(law.factor, 3.0, 1e-12);
}

TEST(PowerLaw, SaysOneOfWhatGrowsInProportionAndNoughtOfWhatStays) {
  const std::vector<double> x = {1.0, 2.0, 4.0};
  EXPECT_NEAR(fit_power_law(x, std::vector<double>{5.0, 10.0, 20.0}).exponent, 1.0, 1e-12);
  EXPECT_NEAR(fit_power_law(x, std::vector<double>{5.0, 5.0, 5.0}).exponent, 0.0, 1e-12);
}

TEST(PowerLawDeathTest, RefusesWhatHasNoLogarithmOrNoSlope) {
  const std::vector<double> one = {1.0, 1.0};
  const std::vector<double> nought = {0.0, 1.0};
  EXPECT_DEATH((void)fit_power_law(one, one), "two different x");
  EXPECT_DEATH((void)fit_power_law(nought, one), "above 0");
}

}  // namespace
}  // namespace darkling
