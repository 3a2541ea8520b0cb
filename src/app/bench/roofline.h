// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "kernels/kernel_costs.h"

namespace darkling {

// What a machine does at most, as measured on it.
struct MachineSpeed {
  double bytes_per_ns = 0.0;            // copied, read and written bytes together
  double byte_operations_per_ns = 0.0;  // see kernels/kernel_costs.h
  double float_operations_per_ns = 0.0;
};

// The least time some work can take: that of its bytes or that of its arithmetic, whichever is
// longer.
// Source: Williams, Waterman, Patterson, "Roofline: an insightful visual performance model for
// multicore architectures", 2009.
struct Roofline {
  double memory_ns = 0.0;
  double arithmetic_ns = 0.0;

  [[nodiscard]] bool is_memory_bound() const { return memory_ns > arithmetic_ns; }
  [[nodiscard]] double bound_ns() const { return is_memory_bound() ? memory_ns : arithmetic_ns; }
  Roofline& operator+=(const Roofline& other) {
    memory_ns += other.memory_ns;
    arithmetic_ns += other.arithmetic_ns;
    return *this;
  }
};

[[nodiscard]] Roofline roofline(const KernelCost& cost, const MachineSpeed& speed);

// y ≈ factor · x ^ exponent.
struct PowerLaw {
  double factor = 0.0;
  double exponent = 0.0;
};

// The line of least squares through the logarithms.
// @pre as many x as y, all above 0, and at least two different x.
[[nodiscard]] PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace darkling
