// SPDX-License-Identifier: Apache-2.0
// Deterministic randomness: integer hashes in place of a generator with a state, so that a pixel's
// noise depends on nothing but its key.
#pragma once

#include <cstdint>

namespace darkling {

// A bijective scramble of 64 bits (the finaliser of SplitMix64).
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// A hash as a number in [0, 1).
[[nodiscard]] constexpr float unit_float(std::uint32_t h) {
  return static_cast<float>(h >> 8) * (1.0f / 16777216.0f);
}

}  // namespace darkling
