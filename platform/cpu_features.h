// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/cpu_features.h"

namespace darkling {

// What the processor we run on, and its operating system, let us use. Never fails: what cannot be
// found out is not there.
[[nodiscard]] CpuFeatures detect_cpu_features();

}  // namespace darkling
