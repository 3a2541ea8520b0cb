// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/arithmetic_peak.h"

namespace darkling {

void byte_arithmetic_avx2(int rounds, void* out) {
  const __m256i a = _mm256_set1_epi8(3);
  const __m256i b = _mm256_set1_epi8(7);
  __m256i chains[kArithmeticChains];
  for (int k = 0; k < kArithmeticChains; ++k) {
    chains[k] = _mm256_set1_epi8(static_cast<char>(k));
  }
  for (int i = 0; i < rounds; ++i) {
    for (__m256i& x : chains) x = _mm256_max_epu8(_mm256_add_epi8(x, a), b);
  }
  for (int k = 1; k < kArithmeticChains; ++k) chains[0] = _mm256_add_epi8(chains[0], chains[k]);
  _mm256_storeu_si256(static_cast<__m256i*>(out), chains[0]);
}

void float_arithmetic_avx2(int rounds, void* out) {
  const __m256 a = _mm256_set1_ps(0.5f);
  const __m256 b = _mm256_set1_ps(0.75f);
  __m256 chains[kArithmeticChains];
  for (int k = 0; k < kArithmeticChains; ++k) chains[k] = _mm256_set1_ps(static_cast<float>(k));
  for (int i = 0; i < rounds; ++i) {
    for (__m256& x : chains) x = _mm256_add_ps(_mm256_mul_ps(x, a), b);
  }
  for (int k = 1; k < kArithmeticChains; ++k) chains[0] = _mm256_add_ps(chains[0], chains[k]);
  _mm256_storeu_ps(static_cast<float*>(out), chains[0]);
}

}  // namespace darkling
