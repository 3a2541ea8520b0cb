// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace darkling {

// Arithmetic on registers alone, as fast as an instruction set lets it go: the bound that no kernel
// of that instruction set can beat. Twelve independent chains, enough to hide the latency of two
// units and few enough for sixteen registers, each takes two steps a round.
inline constexpr int kArithmeticChains = 12;
inline constexpr int kArithmeticSteps = 2 * kArithmeticChains;  // vector operations a round

// Does `rounds` rounds; bytes: x ← max(x + a, b), floats: x ← x · a + b, unfused. What comes of it
// is stored to `out`, a vector wide, so that nothing can be left out.
using ArithmeticFn = void(int rounds, void* out);
ArithmeticFn byte_arithmetic_ref;
ArithmeticFn byte_arithmetic_avx2;
ArithmeticFn byte_arithmetic_neon;
ArithmeticFn float_arithmetic_ref;
ArithmeticFn float_arithmetic_avx2;
ArithmeticFn float_arithmetic_neon;

inline constexpr std::size_t kMaxVectorBytes = 32;
struct ArithmeticPeak {
  int vector_bytes = 16;
  ArithmeticFn* bytes = byte_arithmetic_ref;
  ArithmeticFn* floats = float_arithmetic_ref;
};

// @param kernels  the name of a KernelTable. The vectors of sse41 are those of ref on x86-64.
[[nodiscard]] ArithmeticPeak arithmetic_peak(std::string_view kernels);

}  // namespace darkling
