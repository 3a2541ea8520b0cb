// SPDX-License-Identifier: Apache-2.0
// What the kernel benchmarks share: names, sizes and the two figures that compare across machines.
#pragma once

#include <benchmark/benchmark.h>

#include "kernels/kernel_table.h"

namespace darkling::bench {

using KernelBench = void (*)(benchmark::State& state, const KernelTable& table, int width,
                             int height);

// Registers `run` as KERNEL/ISA/WIDTHxHEIGHT for every table of this processor and every size of
// thumbnail that matters. Returns true, so that a constant can be initialised with it.
bool for_each_table_and_size(const char* kernel, KernelBench run);

// Adds time a pixel (printed as "290ps") and bytes a second. @param bytes_per_pixel  read and
// written.
void report_per_pixel(benchmark::State& state, int pixels, int bytes_per_pixel);

}  // namespace darkling::bench
