// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "base/time.h"

namespace darkling {

// From either end of an exposure to its middle. @param exposure_ms  below 0: not known, taken for
// 0.
[[nodiscard]] inline Duration half_exposure(double exposure_ms) {
  constexpr double kLongest_ms = 60'000.0;
  return Duration{std::llround(std::clamp(exposure_ms, 0.0, kLongest_ms) * 0.5e6)};
}

}  // namespace darkling
