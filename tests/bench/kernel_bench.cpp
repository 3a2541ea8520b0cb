// SPDX-License-Identifier: Apache-2.0
// Every kernel of every table of this processor, as KERNEL/ISA/WIDTHxHEIGHT, with the inputs that
// `darkling bench` measures them with; so Google Benchmark's filters and comparisons can be used.
#include <cstdio>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "app/bench/kernel_workloads.h"
#include "platform/cpu_features.h"

namespace darkling {
namespace {

constexpr struct {
  int width;
  int height;
} kSizes[] = {{160, 120}, {320, 240}, {640, 480}};
constexpr int kPoints = 1000;

void bench(benchmark::State& state, const KernelWorkload& workload, const KernelTable& table) {
  for (auto _ : state) {
    workload.run(table);
    benchmark::ClobberMemory();
  }
  const double units = static_cast<double>(state.iterations()) * workload.units;
  state.counters[std::string("time_per_") + name_of(workload.kernel).unit] =
      benchmark::Counter(units, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["bytes_per_second"] =
      benchmark::Counter(units * workload.cost.bytes, benchmark::Counter::kIsRate);
}

void add_benchmarks(const KernelWorkloads& workloads, const std::vector<KernelTable>& tables) {
  const std::string size =
      std::to_string(workloads.width()) + "x" + std::to_string(workloads.height());
  for (const KernelWorkload& workload : workloads.all()) {
    for (const KernelTable& table : tables) {
      const std::string name =
          std::string(name_of(workload.kernel).name) + "/" + table.name + "/" + size;
      benchmark::RegisterBenchmark(
          name.c_str(), [&workload, &table](benchmark::State& s) { bench(s, workload, table); });
    }
  }
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const std::vector<KernelTable> tables = available_tables(detect_cpu_features());
  std::vector<KernelWorkloads> all;
  all.reserve(std::size(kSizes));
  for (const auto& size : kSizes) {
    auto workloads = KernelWorkloads::create_rendered(size.width, size.height, kPoints);
    if (!workloads) {
      std::fprintf(stderr, "%s\n", workloads.error().message.c_str());
      return 1;
    }
    add_benchmarks(all.emplace_back(std::move(*workloads)), tables);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace darkling

int main(int argc, char** argv) {
  return darkling::run(argc, argv);
}
