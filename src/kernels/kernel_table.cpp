// SPDX-License-Identifier: Apache-2.0
#include "kernels/kernel_table.h"

#include <algorithm>
#include <iterator>

namespace darkling {
namespace {

// One instruction set: when it may be used and which functions it brings.
struct InstructionSet {
  const char* name;
  bool (*is_available)(const CpuFeatures& cpu);
  void (*overwrite)(KernelTable& table);
};

bool always(const CpuFeatures&) {
  return true;
}
void keep_references(KernelTable&) {}

#ifdef DARKLING_HAS_X86_KERNELS
bool has_sse41(const CpuFeatures& cpu) {
  return cpu.sse41;
}
bool has_avx2(const CpuFeatures& cpu) {
  return cpu.sse41 && cpu.avx2;
}

void overwrite_sse41(KernelTable& table) {
  table.take_patch = take_patch_sse41;
  table.remap_area = remap_area_sse41;
  table.halve = halve_sse41;
  table.bit_planes = bit_planes_sse41;
  table.saliency = saliency_sse41;
  table.sample_residuals = sample_residuals_sse41;
  table.hamming_row = hamming_row_sse41;
  table.semi_global_row = semi_global_row_sse41;
  table.match_codes = match_codes_sse41;
  table.compare_patch = compare_patch_sse41;
}

// A kernel without a wider variant keeps the narrower one.
void overwrite_avx2(KernelTable& table) {
  overwrite_sse41(table);
  table.remap_area = remap_area_avx2;
  table.halve = halve_avx2;
  table.bit_planes = bit_planes_avx2;
  table.saliency = saliency_avx2;
  table.sample_residuals = sample_residuals_avx2;
  table.normal_equations = normal_equations_avx2;
  table.hamming_row = hamming_row_avx2;
  table.semi_global_row = semi_global_row_avx2;
  table.match_codes = match_codes_avx2;
}
#endif

#ifdef DARKLING_HAS_NEON_KERNELS
bool has_neon(const CpuFeatures& cpu) {
  return cpu.neon;
}
void overwrite_neon(KernelTable& table) {
  table.remap_area = remap_area_neon;
  table.halve = halve_neon;
  table.bit_planes = bit_planes_neon;
  table.saliency = saliency_neon;
  table.sample_residuals = sample_residuals_neon;
  table.hamming_row = hamming_row_neon;
  table.semi_global_row = semi_global_row_neon;
  table.match_codes = match_codes_neon;
  table.compare_patch = compare_patch_neon;
  table.take_patch = take_patch_neon;
}
#endif

// What this build holds, from slowest to fastest.
constexpr InstructionSet kInstructionSets[] = {
    {"ref", always, keep_references},
#ifdef DARKLING_HAS_X86_KERNELS
    {"sse41", has_sse41, overwrite_sse41},
    {"avx2", has_avx2, overwrite_avx2},
#endif
#ifdef DARKLING_HAS_NEON_KERNELS
    {"neon", has_neon, overwrite_neon},
#endif
};

bool is_known(std::string_view name) {
  constexpr std::string_view kNames[] = {"ref", "sse41", "avx2", "neon"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace

Result<KernelTable> select_kernels(std::string_view name, const CpuFeatures& cpu) {
  const InstructionSet* chosen = nullptr;
  for (const InstructionSet& set : kInstructionSets) {
    if ((name == "auto" || name == set.name) && set.is_available(cpu)) chosen = &set;
  }
  if (chosen == nullptr) {
    const char* fault = is_known(name) ? "not available on this processor" : "not known";
    return failure(ExitCode::kUsage, "kernels `" + std::string(name) + "` are " + fault +
                                         "; use one of: auto, " + available_kernels(cpu));
  }
  KernelTable table;
  table.name = chosen->name;
  chosen->overwrite(table);
  return table;
}

std::string available_kernels(const CpuFeatures& cpu) {
  std::string names;
  for (const InstructionSet& set : kInstructionSets) {
    if (!set.is_available(cpu)) continue;
    if (!names.empty()) names += ", ";
    names += set.name;
  }
  return names;
}

}  // namespace darkling
