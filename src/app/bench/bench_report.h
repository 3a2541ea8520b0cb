// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/bench/measure_kernels.h"
#include "app/bench/measure_stages.h"
#include "app/bench/measure_sweep.h"

namespace darkling {

// What was measured, as far as it was asked for.
struct BenchReport {
  std::optional<KernelReport> kernels;
  std::optional<StageReport> stages;
  std::optional<SweepReport> sweep;
};

// Aligned tables for a person.
[[nodiscard]] std::string format_bench_tables(const BenchReport& report);

// The same figures; parts that were not asked for have no key, figures that there are not are null.
[[nodiscard]] std::string format_bench_json(const BenchReport& report);

}  // namespace darkling
