// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "base/cpu_features.h"
#include "base/result.h"
#include "kernels/bit_planes.h"
#include "kernels/halve.h"
#include "kernels/match_patch.h"
#include "kernels/normal_equations.h"
#include "kernels/remap_area.h"
#include "kernels/saliency.h"
#include "kernels/sample_residuals.h"
#include "kernels/semi_global.h"
#include "kernels/take_patch.h"

namespace darkling {

// One function a kernel. Filled with the references first, then overwritten by what the chosen
// instruction set has.
struct KernelTable {
  const char* name = "ref";  // the instruction set: ref, sse41, avx2 or neon
  RemapAreaFn* remap_area = remap_area_ref;
  HalveFn* halve = halve_ref;
  BitPlanesFn* bit_planes = bit_planes_ref;
  SaliencyFn* saliency = saliency_ref;
  TakePatchFn* take_patch = take_patch_ref;
  SampleResidualsFn* sample_residuals = sample_residuals_ref;
  NormalEquationsFn* normal_equations = normal_equations_ref;
  HammingRowFn* hamming_row = hamming_row_ref;
  SemiGlobalRowFn* semi_global_row = semi_global_row_ref;
  MatchCodesFn* match_codes = match_codes_ref;
  ComparePatchFn* compare_patch = compare_patch_ref;
};

// @param name  ref, sse41, avx2, neon, or auto for the best that the processor has.
// @return kUsage for a name that is unknown or not available here; the message lists what is.
[[nodiscard]] Result<KernelTable> select_kernels(std::string_view name, const CpuFeatures& cpu);

// The names select_kernels() accepts on this processor, ref first, auto left out: "ref, sse41".
[[nodiscard]] std::string available_kernels(const CpuFeatures& cpu);

}  // namespace darkling
