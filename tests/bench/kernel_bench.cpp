// SPDX-License-Identifier: Apache-2.0
#include "bench/kernel_bench.h"

#include <string>

#include "support/kernel_cases.h"

namespace darkling::bench {

bool for_each_table_and_size(const char* kernel, KernelBench run) {
  constexpr struct {
    int width;
    int height;
  } kSizes[] = {{160, 120}, {320, 240}, {640, 480}};
  for (const auto& size : kSizes) {
    for (const KernelTable& table : test::available_tables()) {
      const std::string name = std::string(kernel) + "/" + table.name + "/" +
                               std::to_string(size.width) + "x" + std::to_string(size.height);
      benchmark::RegisterBenchmark(name.c_str(), [run, table, size](benchmark::State& state) {
        run(state, table, size.width, size.height);
      });
    }
  }
  return true;
}

void report_per_pixel(benchmark::State& state, int pixels, int bytes_per_pixel) {
  const auto total_pixels = static_cast<double>(pixels * state.iterations());
  state.SetBytesProcessed(state.iterations() * pixels * bytes_per_pixel);
  state.counters["time_per_px"] =
      benchmark::Counter(total_pixels, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace darkling::bench
