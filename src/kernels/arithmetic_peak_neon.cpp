// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/arithmetic_peak.h"

namespace darkling {

void byte_arithmetic_neon(int rounds, void* out) {
  const uint8x16_t a = vdupq_n_u8(3);
  const uint8x16_t b = vdupq_n_u8(7);
  uint8x16_t chains[kArithmeticChains];
  for (int k = 0; k < kArithmeticChains; ++k) chains[k] = vdupq_n_u8(static_cast<std::uint8_t>(k));
  for (int i = 0; i < rounds; ++i) {
    for (uint8x16_t& x : chains) x = vmaxq_u8(vaddq_u8(x, a), b);
  }
  for (int k = 1; k < kArithmeticChains; ++k) chains[0] = vaddq_u8(chains[0], chains[k]);
  vst1q_u8(static_cast<std::uint8_t*>(out), chains[0]);
}

void float_arithmetic_neon(int rounds, void* out) {
  const float32x4_t a = vdupq_n_f32(0.5f);
  const float32x4_t b = vdupq_n_f32(0.75f);
  float32x4_t chains[kArithmeticChains];
  for (int k = 0; k < kArithmeticChains; ++k) chains[k] = vdupq_n_f32(static_cast<float>(k));
  for (int i = 0; i < rounds; ++i) {
    for (float32x4_t& x : chains) x = vaddq_f32(vmulq_f32(x, a), b);
  }
  for (int k = 1; k < kArithmeticChains; ++k) chains[0] = vaddq_f32(chains[0], chains[k]);
  vst1q_f32(static_cast<float*>(out), chains[0]);
}

}  // namespace darkling
