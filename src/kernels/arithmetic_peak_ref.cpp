// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "kernels/arithmetic_peak.h"

namespace darkling {

namespace {

// Vectors of the baseline: the compiler makes scalars of them where it has none.
typedef std::uint8_t Bytes [[gnu::vector_size(16)]];
typedef float Floats [[gnu::vector_size(16)]];

}  // namespace

void byte_arithmetic_ref(int rounds, void* out) {
  const Bytes a = Bytes{} + 3;
  const Bytes b = Bytes{} + 7;
  Bytes chains[kArithmeticChains];
  for (int k = 0; k < kArithmeticChains; ++k) chains[k] = Bytes{} + static_cast<std::uint8_t>(k);
  for (int i = 0; i < rounds; ++i) {
    for (Bytes& x : chains) {
      const Bytes sum = x + a;
      x = sum > b ? sum : b;
    }
  }
  for (int k = 1; k < kArithmeticChains; ++k) chains[0] += chains[k];
  std::memcpy(out, &chains[0], sizeof(Bytes));
}

void float_arithmetic_ref(int rounds, void* out) {
  const Floats a = Floats{} + 0.5f;
  const Floats b = Floats{} + 0.75f;
  Floats chains[kArithmeticChains];
  for (int k = 0; k < kArithmeticChains; ++k) chains[k] = Floats{} + static_cast<float>(k);
  for (int i = 0; i < rounds; ++i) {
    for (Floats& x : chains) x = x * a + b;
  }
  for (int k = 1; k < kArithmeticChains; ++k) chains[0] += chains[k];
  std::memcpy(out, &chains[0], sizeof(Floats));
}

}  // namespace darkling
