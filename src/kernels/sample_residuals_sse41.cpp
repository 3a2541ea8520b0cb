// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/sample_residuals.h"

namespace darkling {
namespace {

constexpr int kHalf = kPointLanes / 2;  // a vector

// Eight warped points, an array a member so that each can be looked at alone.
struct Positions {
  alignas(16) std::int32_t u_q12[kPointLanes];
  alignas(16) std::int32_t v_q12[kPointLanes];
  // w00 | w01 << 16 and w10 | w11 << 16: neighbours' bilinear weights as one 32-bit number.
  alignas(16) std::int32_t upper[kPointLanes];
  alignas(16) std::int32_t lower[kPointLanes];
  int inside;  // a bit a point
};

// Where the pixels end in which a point may lie.
struct Ends {
  float u;
  float v;
};

void store(std::int32_t* to, __m128i value) {
  _mm_store_si128(reinterpret_cast<__m128i*>(to), value);
}

// Row i of A · (x, y, f) + a · s.
__m128 transform(const PointWarp& warp, int i, __m128 x, __m128 y, __m128 s) {
  const float* A = warp.A + 3 * i;
  const __m128 Ax = _mm_mul_ps(_mm_set1_ps(A[0]), x);
  const __m128 Ay = _mm_mul_ps(_mm_set1_ps(A[1]), y);
  const __m128 as = _mm_mul_ps(_mm_set1_ps(warp.a[i]), s);
  const __m128 Axy = _mm_add_ps(Ax, Ay);
  return _mm_add_ps(_mm_add_ps(Axy, _mm_set1_ps(A[2] * warp.focal_px)), as);
}

__m128 to_pixel(__m128 ray, __m128 Z, float focal_px, float centre_px) {
  const __m128 scaled = _mm_mul_ps(_mm_set1_ps(focal_px), ray);
  return _mm_add_ps(_mm_div_ps(scaled, Z), _mm_set1_ps(centre_px));
}

__m128 is_between(__m128 pixel, float end) {
  return _mm_and_ps(_mm_cmpge_ps(pixel, _mm_set1_ps(1.0f)), _mm_cmplt_ps(pixel, _mm_set1_ps(end)));
}

// Of the four points from `k`.
void put_weights(__m128i u_q12, __m128i v_q12, int k, Positions& out) {
  const __m128i fraction = _mm_set1_epi32(4095);
  const __m128i fx = _mm_and_si128(u_q12, fraction);
  const __m128i fy = _mm_and_si128(v_q12, fraction);
  const __m128i product = _mm_madd_epi16(fx, fy);  // their upper halves are 0
  const __m128i w11 = _mm_srli_epi32(_mm_add_epi32(product, _mm_set1_epi32(512)), 10);
  const __m128i fx4 = _mm_slli_epi32(fx, 2);
  const __m128i w01 = _mm_sub_epi32(fx4, w11);
  const __m128i w10 = _mm_sub_epi32(_mm_slli_epi32(fy, 2), w11);
  const __m128i rest = _mm_add_epi32(fx4, w10);
  const __m128i w00 = _mm_sub_epi32(_mm_set1_epi32(16384), rest);
  store(out.upper + k, _mm_or_si128(w00, _mm_slli_epi32(w01, 16)));
  store(out.lower + k, _mm_or_si128(w10, _mm_slli_epi32(w11, 16)));
}

// Warps points first + k … first + k + 3; returns a bit each for those in the image.
int warp_4(const TemplatePoints& points, int first, int k, const PointWarp& warp, const Ends& ends,
           Positions& out) {
  const __m128 x = _mm_loadu_ps(points.x + first + k);
  const __m128 y = _mm_loadu_ps(points.y + first + k);
  const __m128 s = _mm_loadu_ps(points.inverse_depth_focal + first + k);
  const __m128 Z = transform(warp, 2, x, y, s);
  const __m128 u = to_pixel(transform(warp, 0, x, y, s), Z, warp.focal_px, warp.cx);
  const __m128 v = to_pixel(transform(warp, 1, x, y, s), Z, warp.focal_px, warp.cy);
  const __m128 is_before = _mm_cmpgt_ps(Z, _mm_setzero_ps());
  const __m128 is_inside = _mm_and_ps(is_between(u, ends.u), is_between(v, ends.v));
  const __m128 unit = _mm_set1_ps(4096.0f);
  const __m128i u_q12 = _mm_cvttps_epi32(_mm_mul_ps(u, unit));
  const __m128i v_q12 = _mm_cvttps_epi32(_mm_mul_ps(v, unit));
  store(out.u_q12 + k, u_q12);
  store(out.v_q12 + k, v_q12);
  put_weights(u_q12, v_q12, k, out);
  return _mm_movemask_ps(_mm_and_ps(is_before, is_inside));
}

struct Eight {
  __m128i low;
  __m128i high;
};

// Two neighbouring pixels of one row, weighted and added: eight planes, in 1/16384.
Eight blend_row(const std::uint8_t* row, std::int32_t weights) {
  const __m128i two = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row));
  const __m128i pairs = _mm_unpacklo_epi8(two, _mm_srli_si128(two, kPlaneCount));
  const __m128i w = _mm_set1_epi32(weights);
  return {_mm_madd_epi16(_mm_cvtepu8_epi16(pairs), w),
          _mm_madd_epi16(_mm_unpackhi_epi8(pairs, _mm_setzero_si128()), w)};
}

// r_c of one point in 1/64.
__m128i residual(const std::uint8_t* at, std::ptrdiff_t stride, std::int32_t upper_weights,
                 std::int32_t lower_weights, const PlanePatch& patch) {
  const Eight upper = blend_row(at, upper_weights);
  const Eight lower = blend_row(at + stride, lower_weights);
  const auto rounded = [](__m128i a, __m128i b) {
    return _mm_srai_epi32(_mm_add_epi32(_mm_add_epi32(a, b), _mm_set1_epi32(128)), 8);
  };
  const __m128i words =
      _mm_packs_epi32(rounded(upper.low, lower.low), rounded(upper.high, lower.high));
  const __m128i reference =
      _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(patch.reference)));
  return _mm_sub_epi16(words, _mm_slli_epi16(reference, 6));
}

__m128i products(__m128i residuals, const std::int16_t* gradients) {
  return _mm_madd_epi16(residuals, _mm_loadu_si128(reinterpret_cast<const __m128i*>(gradients)));
}

// The three sums of eight points, each in four parts, as they come.
struct Sums {
  __m128i parts[3][kPointLanes];
};

void compare_point(const ImageView<const std::uint8_t>& planes, const Positions& at, int k,
                   const PlanePatch& patch, Sums& sums) {
  const std::uint8_t* upper =
      planes.data + (at.v_q12[k] >> 12) * planes.stride + (at.u_q12[k] >> 12) * kPlaneCount;
  const __m128i r = residual(upper, planes.stride, at.upper[k], at.lower[k], patch);
  sums.parts[0][k] = products(r, patch.gx2);
  sums.parts[1][k] = products(r, patch.gy2);
  sums.parts[2][k] = _mm_madd_epi16(r, r);
}

// Adds up the parts of eight points and writes them as floats, `outside` for those not in `inside`.
void put(float* to, const __m128i parts[kPointLanes], float unit, float outside, int inside) {
  for (int k = 0; k < kPointLanes; k += kHalf) {
    const __m128i sums = _mm_hadd_epi32(_mm_hadd_epi32(parts[k], parts[k + 1]),
                                        _mm_hadd_epi32(parts[k + 2], parts[k + 3]));
    const __m128 values = _mm_mul_ps(_mm_cvtepi32_ps(sums), _mm_set1_ps(unit));
    const __m128i bit = _mm_setr_epi32(1, 2, 4, 8);
    const __m128i is_inside = _mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(inside >> k), bit), bit);
    _mm_storeu_ps(to + k, _mm_blendv_ps(_mm_set1_ps(outside), values, _mm_castsi128_ps(is_inside)));
  }
}

}  // namespace

int sample_residuals_sse41(const TemplatePoints& points, const PointWarp& warp,
                           ImageView<const std::uint8_t> planes, const PointResiduals& out) {
  const int width = planes.width / kPlaneCount;
  const Ends ends = {static_cast<float>(width - 2), static_cast<float>(planes.height - 2)};
  int visible = 0;
  Sums sums = {};
  for (int first = 0; first < points.count; first += kPointLanes) {
    Positions at;
    at.inside = warp_4(points, first, 0, warp, ends, at);
    at.inside |= warp_4(points, first, kHalf, warp, ends, at) << kHalf;
    if (points.count - first < kPointLanes) at.inside &= (1 << (points.count - first)) - 1;
    for (int left = at.inside; left != 0; left &= left - 1) {
      const int k = __builtin_ctz(static_cast<unsigned>(left));
      compare_point(planes, at, k, points.patches[first + k], sums);
      ++visible;
    }
    put(out.bx + first, sums.parts[0], 1.0f / 128.0f, 0.0f, at.inside);
    put(out.by + first, sums.parts[1], 1.0f / 128.0f, 0.0f, at.inside);
    put(out.squares + first, sums.parts[2], 1.0f / 4096.0f, -1.0f, at.inside);
  }
  return visible;
}

}  // namespace darkling
