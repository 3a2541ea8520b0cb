// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/normal_equations.h"

namespace darkling {
namespace {

// The weights of eight points.
__m256 robust_weights(__m256 squares, float inverse_scale) {
  const __m256 one = _mm256_set1_ps(1.0f);
  const __m256 d = _mm256_add_ps(one, _mm256_mul_ps(squares, _mm256_set1_ps(inverse_scale)));
  const __m256 w = _mm256_div_ps(one, d);
  const __m256 is_outside = _mm256_cmp_ps(squares, _mm256_setzero_ps(), _CMP_LT_OQ);
  return _mm256_andnot_ps(is_outside, _mm256_mul_ps(w, w));
}

__m256 negate(__m256 a) {
  return _mm256_xor_ps(a, _mm256_set1_ps(-0.0f));
}

struct LaneSums {
  __m256 H[NormalSums::kEntries];
  __m256 g[6];
};

// a · c + b · d.
__m256 dot(__m256 a, __m256 c, __m256 b, __m256 d) {
  return _mm256_add_ps(_mm256_mul_ps(a, c), _mm256_mul_ps(b, d));
}

// Unrolled, the zeros of J still cost their multiplications: left in, so that infinities and signs
// of zero come out as the reference's.
void add_8(const TemplatePoints& points, const PointResiduals& residuals, int i, __m256 f,
           float inverse_scale, LaneSums& sums) {
  const __m256 w = robust_weights(_mm256_loadu_ps(residuals.squares + i), inverse_scale);
  const __m256 X = _mm256_mul_ps(_mm256_loadu_ps(points.x + i), f);
  const __m256 Y = _mm256_mul_ps(_mm256_loadu_ps(points.y + i), f);
  const __m256 s = _mm256_mul_ps(_mm256_loadu_ps(points.inverse_depth_focal + i), f);
  const __m256 XY = _mm256_mul_ps(X, Y);
  const __m256 one = _mm256_set1_ps(1.0f);
  const __m256 zero = _mm256_setzero_ps();
  const __m256 Ju[6] = {s,
                        zero,
                        negate(_mm256_mul_ps(X, s)),
                        negate(XY),
                        _mm256_add_ps(one, _mm256_mul_ps(X, X)),
                        negate(Y)};
  const __m256 Jv[6] = {
      zero, s, negate(_mm256_mul_ps(Y, s)), negate(_mm256_add_ps(one, _mm256_mul_ps(Y, Y))), XY, X};
  const __m256 Sxx = _mm256_mul_ps(w, _mm256_loadu_ps(points.Sxx + i));
  const __m256 Sxy = _mm256_mul_ps(w, _mm256_loadu_ps(points.Sxy + i));
  const __m256 Syy = _mm256_mul_ps(w, _mm256_loadu_ps(points.Syy + i));
  const __m256 bx = _mm256_mul_ps(w, _mm256_loadu_ps(residuals.bx + i));
  const __m256 by = _mm256_mul_ps(w, _mm256_loadu_ps(residuals.by + i));
  __m256* H = sums.H;
  for (int a = 0; a < 6; ++a) {
    const __m256 SJu = dot(Sxx, Ju[a], Sxy, Jv[a]);
    const __m256 SJv = dot(Sxy, Ju[a], Syy, Jv[a]);
    for (int b = a; b < 6; ++b, ++H) *H = _mm256_add_ps(*H, dot(SJu, Ju[b], SJv, Jv[b]));
    sums.g[a] = _mm256_add_ps(sums.g[a], dot(bx, Ju[a], by, Jv[a]));
  }
}

// ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)).
float add_up(__m256 lanes) {
  const __m128 four = _mm_add_ps(_mm256_castps256_ps128(lanes), _mm256_extractf128_ps(lanes, 1));
  const __m128 two = _mm_add_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1)));
}

}  // namespace

void normal_equations_avx2(const TemplatePoints& points, const PointResiduals& residuals,
                           float focal_px, float inverse_scale, NormalSums& sums) {
  LaneSums lanes;
  for (__m256& entry : lanes.H) entry = _mm256_setzero_ps();
  for (__m256& entry : lanes.g) entry = _mm256_setzero_ps();
  const __m256 f = _mm256_set1_ps(1.0f / focal_px);
  for (int i = 0; i < points.count; i += kPointLanes) {
    add_8(points, residuals, i, f, inverse_scale, lanes);
  }
  for (int i = 0; i < NormalSums::kEntries; ++i) sums.H[i] = add_up(lanes.H[i]);
  for (int i = 0; i < 6; ++i) sums.g[i] = add_up(lanes.g[i]);
}

}  // namespace darkling
