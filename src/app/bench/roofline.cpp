// SPDX-License-Identifier: Apache-2.0
#include "app/bench/roofline.h"

#include <cmath>

#include "base/check.h"

namespace darkling {

Roofline roofline(const KernelCost& cost, const MachineSpeed& speed) {
  return {cost.bytes / speed.bytes_per_ns,
          cost.byte_operations / speed.byte_operations_per_ns +
              cost.float_operations / speed.float_operations_per_ns};
}

PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y) {
  CHECK(x.size() == y.size() && x.size() >= 2, "a power law needs two pairs of numbers");
  const auto n = static_cast<double>(x.size());
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(x[i] > 0.0 && y[i] > 0.0, "logarithms are of what is above 0");
    sum_x += std::log(x[i]);
    sum_y += std::log(y[i]);
  }
  double sum_xx = 0.0;
  double sum_xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - sum_x / n;
    sum_xx += dx * dx;
    sum_xy += dx * (std::log(y[i]) - sum_y / n);
  }
  CHECK(sum_xx > 0.0, "a power law needs two different x");
  const double exponent = sum_xy / sum_xx;
  return {std::exp((sum_y - exponent * sum_x) / n), exponent};
}

}  // namespace darkling
