// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// What the processor can do, as platform/cpu_features.h found it: the choice of kernels goes by it.
struct CpuFeatures {
  bool sse41 = false;
  bool avx2 = false;
  bool neon = false;
};

}  // namespace darkling
