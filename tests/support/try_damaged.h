// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/damage.h"

namespace darkling::test {

// `target` gets `sound` with one to six damages, `rounds` times; it may refuse, but not throw.
template <class Target>
void try_damaged(const std::vector<std::byte>& sound, const Target& target, int rounds,
                 std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> bytes = sound;
    for (unsigned i = 0; i <= random() % 6; ++i) damage(bytes, random);
    ASSERT_NO_THROW(target(bytes)) << "seed " << seed << ", round " << round;
  }
}

}  // namespace darkling::test
