// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "drivers/injection/injection.h"
#include "drivers/sensor/mix64.h"

namespace darkling {

// A place in the square from -1 to 1.
struct WanderedTo {
  double x = 0.0;
  double y = 0.0;
};

// Where something that wanders about is: a smooth path that returns after 67 · 43 frames, and
// begins elsewhere for every seed.
[[nodiscard]] inline WanderedTo wander(const Injection& injection, std::int64_t sequence) {
  const std::uint64_t start = noise_key(injection, 0, kPath);
  const auto phase = [](std::uint64_t bits) {
    return static_cast<double>(unit_float(static_cast<std::uint32_t>(bits)));
  };
  const auto turn = [sequence](std::int64_t period, double offset) {
    const double share = static_cast<double>(sequence % period) / static_cast<double>(period);
    return std::sin(2.0 * std::numbers::pi * (share + offset));
  };
  return {.x = turn(67, phase(start)), .y = turn(43, phase(start >> 32))};
}

}  // namespace darkling
