// SPDX-License-Identifier: Apache-2.0
#include "app/bench/measure_kernels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "kernels/arithmetic_peak.h"

namespace darkling {

namespace {

using Task = std::function<void()>;

constexpr int kArithmeticRounds = 1000;

// Copies half of a working set into the other half, so that both together are as large.
Task make_copy(double working_set_bytes) {
  constexpr std::size_t kLeast = 1024;
  const std::size_t half = std::max(static_cast<std::size_t>(working_set_bytes / 2.0), kLeast);
  auto bytes = std::make_shared<std::vector<std::uint8_t>>(2 * half, std::uint8_t{1});
  return [bytes, half] {
    std::memcpy(bytes->data() + half, bytes->data(), half);
    asm volatile("" ::: "memory");  // the next copy is not the same as this one
  };
}

Task make_arithmetic(ArithmeticFn* arithmetic) {
  return [arithmetic] {
    std::array<std::uint8_t, kMaxVectorBytes> out;
    arithmetic(kArithmeticRounds, out.data());
    asm volatile("" ::"r"(out.data()) : "memory");
  };
}

// What is timed, in the order in which the timings come back.
struct TaskList {
  std::vector<Task> tasks;

  TaskList(std::span<const KernelWorkload> workloads, std::span<const KernelTable> tables) {
    for (const KernelTable& table : tables) {
      const ArithmeticPeak peak = arithmetic_peak(table.name);
      tasks.push_back(make_arithmetic(peak.bytes));
      tasks.push_back(make_arithmetic(peak.floats));
    }
    for (const KernelWorkload& workload : workloads) {
      tasks.push_back(make_copy(workload.working_set_bytes()));
      for (const KernelTable& table : tables) {
        tasks.push_back([&workload, &table] { workload.run(table); });
      }
    }
  }
};

PeakSpeed make_peak(const KernelTable& table, const Timing& bytes, const Timing& floats) {
  const int vector_bytes = arithmetic_peak(table.name).vector_bytes;
  const double byte_operations = double{kArithmeticSteps} * kArithmeticRounds * vector_bytes;
  return {table.name, byte_operations / bytes.median_ns,
          byte_operations / sizeof(float) / floats.median_ns};
}

VariantTiming make_variant(const KernelTimings& kernel, const PeakSpeed& peak, const Timing& run) {
  const MachineSpeed speed = {kernel.copy_bytes_per_ns, peak.byte_operations_per_ns,
                              peak.float_operations_per_ns};
  return {.kernels = peak.kernels,
          .time = {run.median_ns / kernel.units, run.spread},
          .gain = 1.0,
          .least = roofline(kernel.cost, speed)};
}

}  // namespace

KernelReport measure_kernels(const KernelWorkloads& workloads, std::span<const KernelTable> tables,
                             const InterleavePlan& plan) {
  const TaskList list(workloads.all(), tables);
  const std::vector<Timing> timings = measure_interleaved(list.tasks, plan);
  auto next = timings.begin();
  KernelReport report;
  report.width = workloads.width();
  report.height = workloads.height();
  report.rounds = plan.rounds;
  for (const KernelTable& table : tables) {
    report.peaks.push_back(make_peak(table, next[0], next[1]));
    next += 2;
  }
  for (const KernelWorkload& workload : workloads.all()) {
    KernelTimings& kernel = report.kernels.emplace_back();
    kernel.kernel = workload.kernel;
    kernel.units = workload.units;
    kernel.cost = workload.cost;
    kernel.working_set_bytes = workload.working_set_bytes();
    kernel.copy_bytes_per_ns = kernel.working_set_bytes / next++->median_ns;
    for (const PeakSpeed& peak : report.peaks) {
      VariantTiming variant = make_variant(kernel, peak, *next++);
      if (!kernel.variants.empty()) {
        variant.gain = kernel.variants.front().time.median_ns / variant.time.median_ns;
      }
      kernel.variants.push_back(std::move(variant));
    }
    if (workload.kernel == Kernel::kNormalEquations) report.points = workload.units;
  }
  return report;
}

}  // namespace darkling
