// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "base/cpu_features.h"
#include "base/result.h"
#include "kernels/census.h"

namespace darkling {

// One function a kernel. Filled with the references first, then overwritten by what the chosen
// instruction set has.
struct KernelTable {
  const char* name = "ref";  // the instruction set: ref, sse41, avx2 or neon
  CensusFn* census = census_ref;
};

// @param name  ref, sse41, avx2, neon, or auto for the best that the processor has.
// @return kUsage for a name that is unknown or not available here; the message lists what is.
[[nodiscard]] Result<KernelTable> select_kernels(std::string_view name, const CpuFeatures& cpu);

// The names select_kernels() accepts on this processor, ref first, auto left out: "ref, sse41".
[[nodiscard]] std::string available_kernels(const CpuFeatures& cpu);

}  // namespace darkling
