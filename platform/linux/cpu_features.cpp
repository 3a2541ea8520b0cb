// SPDX-License-Identifier: Apache-2.0
#include "platform/cpu_features.h"

#if defined(__arm__)
#include <asm/hwcap.h>
#include <sys/auxv.h>
#endif

namespace darkling {

#if defined(__x86_64__) || defined(__i386__)
CpuFeatures detect_cpu_features() {
  __builtin_cpu_init();
  // Also asks whether the operating system saves the wide registers.
  return {.sse41 = __builtin_cpu_supports("sse4.1") != 0,
          .avx2 = __builtin_cpu_supports("avx2") != 0};
}
#elif defined(__aarch64__)
// Advanced SIMD is part of the AArch64 Linux ABI.
CpuFeatures detect_cpu_features() {
  return {.neon = true};
}
#elif defined(__arm__)
CpuFeatures detect_cpu_features() {
  return {.neon = (getauxval(AT_HWCAP) & HWCAP_NEON) != 0};
}
#else
CpuFeatures detect_cpu_features() {
  return {};
}
#endif

}  // namespace darkling
