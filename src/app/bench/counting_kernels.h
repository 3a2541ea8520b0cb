// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kernels/kernel_costs.h"
#include "kernels/kernel_table.h"

namespace darkling {

// What one kernel had to do.
struct KernelWork {
  double units = 0.0;
  KernelCost total;  // of all units
};
using FrameWork = std::array<KernelWork, kKernelCount>;  // in the order of Kernel

// A table whose functions note what they have to do and have `table` do it.
// Thread: one at a time in the whole process, and one table at a time.
[[nodiscard]] KernelTable counting_kernels(const KernelTable& table);

// What has been noted since the last call.
[[nodiscard]] FrameWork take_counted_work();

}  // namespace darkling
