// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/bit_planes.h"
#include "kernels/match_patch.h"

namespace darkling {
namespace {

constexpr int kCodeRows = 2 * kCodePatchRadius + 1;
constexpr unsigned long long kSevenBytes = 0x00ff'ffff'ffff'ffffULL;

unsigned long long eight_codes(const std::uint8_t* codes) {
  unsigned long long eight = 0;
  __builtin_memcpy(&eight, codes, sizeof(eight));
  return eight;
}

__m128i load_8(const std::uint8_t* from) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
}

// One pixel's right values between two pixels, less the left ones: 16-bit, in 1/16.
__m128i residual(const std::uint8_t* left, const std::uint8_t* right, __m256i weights) {
  const __m128i pairs = _mm_unpacklo_epi8(load_8(right), load_8(right + kPlaneCount));
  const __m256i value = _mm256_madd_epi16(_mm256_cvtepu8_epi16(pairs), weights);
  const __m256i rounded = _mm256_srai_epi32(_mm256_add_epi32(value, _mm256_set1_epi32(128)), 8);
  const __m128i words =
      _mm_packs_epi32(_mm256_castsi256_si128(rounded), _mm256_extracti128_si256(rounded, 1));
  return _mm_sub_epi16(words, _mm_slli_epi16(_mm_cvtepu8_epi16(load_8(left)), 4));
}

__m128i gradient(const std::uint8_t* left) {
  return _mm_sub_epi16(_mm_cvtepu8_epi16(load_8(left + kPlaneCount)),
                       _mm_cvtepu8_epi16(load_8(left - kPlaneCount)));
}

std::int32_t add_up(__m128i four) {
  const __m128i two = _mm_add_epi32(four, _mm_unpackhi_epi64(four, four));
  return _mm_cvtsi128_si32(_mm_add_epi32(two, _mm_shuffle_epi32(two, 1)));
}

}  // namespace

void match_codes_avx2(const std::uint8_t* left, std::ptrdiff_t left_stride,
                      const std::uint8_t* right, std::ptrdiff_t right_stride, int count,
                      int* cost) {
  unsigned long long patch[kCodeRows];
  const std::uint8_t* rows[kCodeRows];
  for (int j = 0; j < kCodeRows; ++j) {
    const int dy = j - kCodePatchRadius;
    patch[j] = eight_codes(left + dy * left_stride - kCodePatchRadius);
    rows[j] = right + dy * right_stride - kCodePatchRadius;
  }
  for (int k = 0; k < count; ++k) {
    int sum = 0;
    for (int j = 0; j < kCodeRows; ++j) {
      sum += __builtin_popcountll((patch[j] ^ eight_codes(rows[j] - k)) & kSevenBytes);
    }
    cost[k] = sum;
  }
}

PatchFit compare_patch_avx2(const std::uint8_t* left, std::ptrdiff_t left_stride,
                            const std::uint8_t* right, std::ptrdiff_t right_stride,
                            int fraction_q12) {
  const __m256i weights = _mm256_set1_epi32((4096 - fraction_q12) | fraction_q12 << 16);
  __m128i gr = _mm_setzero_si128();
  __m128i gg = gr;
  __m128i rr = gr;
  for (int j = -kPlanePatchRadius; j <= kPlanePatchRadius; ++j) {
    for (int i = -kPlanePatchRadius; i <= kPlanePatchRadius; ++i) {
      const std::uint8_t* l = left + j * left_stride + i * kPlaneCount;
      const __m128i r = residual(l, right + j * right_stride + i * kPlaneCount, weights);
      const __m128i g = gradient(l);
      gr = _mm_add_epi32(gr, _mm_madd_epi16(g, r));
      gg = _mm_add_epi32(gg, _mm_madd_epi16(g, g));
      rr = _mm_add_epi32(rr, _mm_madd_epi16(r, r));
    }
  }
  return {add_up(gr), add_up(gg), add_up(rr)};
}

}  // namespace darkling
