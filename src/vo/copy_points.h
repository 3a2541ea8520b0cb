// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kernels/sample_residuals.h"

namespace darkling {

// Which of `from_count` points is the n-th of `to_count` that are spread evenly over them.
[[nodiscard]] constexpr int spread_index(int n, int to_count, int from_count) {
  return static_cast<int>(std::int64_t{n} * from_count / to_count);
}

// Copies points, spread evenly over `from` where `to` holds no more than `capacity`.
void copy_points(const TemplatePoints& from, int capacity, TemplatePoints& to);

}  // namespace darkling
