// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/take_patch.h"

namespace darkling {
namespace {

__m128i load_8(const std::uint8_t* from) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
}

// Differences of eight values, 16-bit.
__m128i difference(const std::uint8_t* a, const std::uint8_t* b) {
  return _mm_sub_epi16(_mm_cvtepu8_epi16(load_8(a)), _mm_cvtepu8_epi16(load_8(b)));
}

void store(std::int16_t* to, __m128i value) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), value);
}

}  // namespace

GramMatrix4 take_patch_sse41(const std::uint8_t* planes, std::ptrdiff_t stride, PlanePatch& patch) {
  const __m128i gx2 = difference(planes + kPlaneCount, planes - kPlaneCount);
  const __m128i gy2 = difference(planes + stride, planes - stride);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(patch.reference), load_8(planes));
  store(patch.gx2, gx2);
  store(patch.gy2, gy2);
  const __m128i xx_xy = _mm_hadd_epi32(_mm_madd_epi16(gx2, gx2), _mm_madd_epi16(gx2, gy2));
  const __m128i yy = _mm_madd_epi16(gy2, gy2);
  const __m128i sums = _mm_hadd_epi32(xx_xy, _mm_hadd_epi32(yy, yy));
  return {_mm_cvtsi128_si32(sums), _mm_extract_epi32(sums, 1), _mm_extract_epi32(sums, 2)};
}

}  // namespace darkling
