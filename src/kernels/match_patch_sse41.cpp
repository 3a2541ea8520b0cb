// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/bit_planes.h"
#include "kernels/match_patch.h"

namespace darkling {
namespace {

constexpr int kCodeRows = 2 * kCodePatchRadius + 1;
constexpr int kRowPairs = (kCodeRows + 1) / 2;

__m128i load_8(const std::uint8_t* from) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
}

// Seven rows of eight codes, two a vector; the eighth code of a row and the eighth row are 0.
struct CodePatch {
  __m128i pairs[kRowPairs];
};

CodePatch load_codes(const std::uint8_t* corner, std::ptrdiff_t stride) {
  const __m128i seven_each = _mm_set1_epi64x(0x00ff'ffff'ffff'ffffLL);
  CodePatch patch;
  for (int j = 0; j < kRowPairs; ++j) {
    const std::uint8_t* row = corner + 2 * j * stride;
    const __m128i lower = 2 * j + 1 < kCodeRows ? load_8(row + stride) : _mm_setzero_si128();
    patch.pairs[j] = _mm_and_si128(_mm_unpacklo_epi64(load_8(row), lower), seven_each);
  }
  return patch;
}

__m128i count_bits(__m128i bytes) {
  const __m128i counts = _mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const __m128i nibble = _mm_set1_epi8(15);
  const __m128i low = _mm_and_si128(bytes, nibble);
  const __m128i high = _mm_and_si128(_mm_srli_epi16(bytes, 4), nibble);
  return _mm_add_epi8(_mm_shuffle_epi8(counts, low), _mm_shuffle_epi8(counts, high));
}

// One pixel's right values between two pixels, less the left ones: 16-bit, in 1/16.
__m128i residual(const std::uint8_t* left, const std::uint8_t* right, __m128i weights) {
  const __m128i pairs = _mm_unpacklo_epi8(load_8(right), load_8(right + kPlaneCount));
  const auto value = [weights](__m128i words) {
    const __m128i sum = _mm_add_epi32(_mm_madd_epi16(words, weights), _mm_set1_epi32(128));
    return _mm_srai_epi32(sum, 8);
  };
  const __m128i words = _mm_packs_epi32(value(_mm_cvtepu8_epi16(pairs)),
                                        value(_mm_unpackhi_epi8(pairs, _mm_setzero_si128())));
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

void match_codes_sse41(const std::uint8_t* left, std::ptrdiff_t left_stride,
                       const std::uint8_t* right, std::ptrdiff_t right_stride, int count,
                       int* cost) {
  const CodePatch patch =
      load_codes(left - kCodePatchRadius * left_stride - kCodePatchRadius, left_stride);
  const std::uint8_t* corner = right - kCodePatchRadius * right_stride - kCodePatchRadius;
  for (int k = 0; k < count; ++k) {
    const CodePatch other = load_codes(corner - k, right_stride);
    __m128i sum = _mm_setzero_si128();  // a byte counts to 32 at most
    for (int j = 0; j < kRowPairs; ++j) {
      sum = _mm_add_epi8(sum, count_bits(_mm_xor_si128(patch.pairs[j], other.pairs[j])));
    }
    const __m128i halves = _mm_sad_epu8(sum, _mm_setzero_si128());
    cost[k] = _mm_cvtsi128_si32(_mm_add_epi32(halves, _mm_unpackhi_epi64(halves, halves)));
  }
}

PatchFit compare_patch_sse41(const std::uint8_t* left, std::ptrdiff_t left_stride,
                             const std::uint8_t* right, std::ptrdiff_t right_stride,
                             int fraction_q12) {
  const __m128i weights = _mm_set1_epi32((4096 - fraction_q12) | fraction_q12 << 16);
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
