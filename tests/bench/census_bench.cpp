// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <vector>

#include "bench/kernel_bench.h"
#include "support/kernel_cases.h"

namespace darkling {
namespace {

void bench_census(benchmark::State& state, CensusFn* census, int width, int height) {
  std::vector<std::uint8_t> pixels(width * height);
  std::vector<std::uint8_t> codes(width * height);
  const ImageView<std::uint8_t> src(pixels.data(), width, height, width);
  const ImageView<std::uint8_t> dst(codes.data(), width, height, width);
  test::fill_image(src, test::Fill::kUniform, 1);
  for (auto _ : state) {
    census(src, dst);
    benchmark::DoNotOptimize(codes.data());
    benchmark::ClobberMemory();
  }
  bench::report_per_pixel(state, width * height, 2);
}

const bool kIsRegistered = bench::for_each_table_and_size(
    "census", [](benchmark::State& state, const KernelTable& table, int width, int height) {
      bench_census(state, table.census, width, height);
    });

}  // namespace
}  // namespace darkling
