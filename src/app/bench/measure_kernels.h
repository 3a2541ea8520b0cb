// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/bench/interleave.h"
#include "app/bench/kernel_workloads.h"
#include "app/bench/roofline.h"

namespace darkling {

// How fast one variant of a kernel is, for each unit.
struct VariantTiming {
  std::string kernels;  // the table it is of: ref, sse41, avx2 or neon
  Timing time;          // of one unit
  double gain = 1.0;    // how many times as fast as the reference
  Roofline least;       // on this machine with this instruction set, of one unit
};

struct KernelTimings {
  Kernel kernel = Kernel::kRemapArea;
  int units = 0;
  KernelCost cost;  // of one unit
  double working_set_bytes = 0.0;
  double copy_bytes_per_ns = 0.0;  // of a working set as large
  std::vector<VariantTiming> variants;
};

// Of one instruction set.
struct PeakSpeed {
  std::string kernels;
  double byte_operations_per_ns = 0.0;
  double float_operations_per_ns = 0.0;
};

struct KernelReport {
  int width = 0;   // px, of the thumbnail
  int height = 0;  // px
  int points = 0;  // of the template
  int rounds = 0;  // samples that every median is of
  std::vector<PeakSpeed> peaks;
  std::vector<KernelTimings> kernels;  // in the order of Kernel
};

// Times every kernel of every table, and in the same rounds what the machine can do: copying as
// much memory as the kernel goes through, and arithmetic on registers.
// @param tables  the reference first: the others' gain is over it.
[[nodiscard]] KernelReport measure_kernels(const KernelWorkloads& workloads,
                                           std::span<const KernelTable> tables,
                                           const InterleavePlan& plan);

}  // namespace darkling
