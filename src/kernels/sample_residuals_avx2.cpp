// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/sample_residuals.h"

namespace darkling {
namespace {

// Eight warped points, an array a member so that each can be looked at alone.
struct Positions {
  alignas(32) std::int32_t u_q12[kPointLanes];
  alignas(32) std::int32_t v_q12[kPointLanes];
  // w00 | w01 << 16 and w10 | w11 << 16: neighbours' bilinear weights as one 32-bit number.
  alignas(32) std::int32_t upper[kPointLanes];
  alignas(32) std::int32_t lower[kPointLanes];
  int inside;  // a bit a point
};

void store(std::int32_t* to, __m256i value) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(to), value);
}

// Row i of A · (x, y, f) + a · s.
__m256 transform(const PointWarp& warp, int i, __m256 x, __m256 y, __m256 s) {
  const float* A = warp.A + 3 * i;
  const __m256 Ax = _mm256_mul_ps(_mm256_set1_ps(A[0]), x);
  const __m256 Ay = _mm256_mul_ps(_mm256_set1_ps(A[1]), y);
  const __m256 as = _mm256_mul_ps(_mm256_set1_ps(warp.a[i]), s);
  const __m256 Axy = _mm256_add_ps(Ax, Ay);
  return _mm256_add_ps(_mm256_add_ps(Axy, _mm256_set1_ps(A[2] * warp.focal_px)), as);
}

__m256 to_pixel(__m256 ray, __m256 Z, float focal_px, float centre_px) {
  const __m256 scaled = _mm256_mul_ps(_mm256_set1_ps(focal_px), ray);
  return _mm256_add_ps(_mm256_div_ps(scaled, Z), _mm256_set1_ps(centre_px));
}

__m256 is_between(__m256 pixel, float end) {
  return _mm256_and_ps(_mm256_cmp_ps(pixel, _mm256_set1_ps(1.0f), _CMP_GE_OQ),
                       _mm256_cmp_ps(pixel, _mm256_set1_ps(end), _CMP_LT_OQ));
}

void put_weights(__m256i u_q12, __m256i v_q12, Positions& out) {
  const __m256i fraction = _mm256_set1_epi32(4095);
  const __m256i fx = _mm256_and_si256(u_q12, fraction);
  const __m256i fy = _mm256_and_si256(v_q12, fraction);
  const __m256i product = _mm256_mullo_epi32(fx, fy);
  const __m256i w11 = _mm256_srli_epi32(_mm256_add_epi32(product, _mm256_set1_epi32(512)), 10);
  const __m256i fx4 = _mm256_slli_epi32(fx, 2);
  const __m256i w01 = _mm256_sub_epi32(fx4, w11);
  const __m256i w10 = _mm256_sub_epi32(_mm256_slli_epi32(fy, 2), w11);
  const __m256i rest = _mm256_add_epi32(fx4, w10);
  const __m256i w00 = _mm256_sub_epi32(_mm256_set1_epi32(16384), rest);
  store(out.upper, _mm256_or_si256(w00, _mm256_slli_epi32(w01, 16)));
  store(out.lower, _mm256_or_si256(w10, _mm256_slli_epi32(w11, 16)));
}

void warp_8(const TemplatePoints& points, int i, const PointWarp& warp, float u_end, float v_end,
            Positions& out) {
  const __m256 x = _mm256_loadu_ps(points.x + i);
  const __m256 y = _mm256_loadu_ps(points.y + i);
  const __m256 s = _mm256_loadu_ps(points.inverse_depth_focal + i);
  const __m256 Z = transform(warp, 2, x, y, s);
  const __m256 u = to_pixel(transform(warp, 0, x, y, s), Z, warp.focal_px, warp.cx);
  const __m256 v = to_pixel(transform(warp, 1, x, y, s), Z, warp.focal_px, warp.cy);
  const __m256 is_before = _mm256_cmp_ps(Z, _mm256_setzero_ps(), _CMP_GT_OQ);
  const __m256 is_inside = _mm256_and_ps(is_between(u, u_end), is_between(v, v_end));
  out.inside = _mm256_movemask_ps(_mm256_and_ps(is_before, is_inside));
  const __m256 unit = _mm256_set1_ps(4096.0f);
  const __m256i u_q12 = _mm256_cvttps_epi32(_mm256_mul_ps(u, unit));
  const __m256i v_q12 = _mm256_cvttps_epi32(_mm256_mul_ps(v, unit));
  store(out.u_q12, u_q12);
  store(out.v_q12, v_q12);
  put_weights(u_q12, v_q12, out);
}

// Two neighbouring pixels of one row, weighted and added: eight planes, in 1/16384.
__m256i blend_row(const std::uint8_t* row, std::int32_t weights) {
  const __m128i two = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row));
  const __m128i pairs = _mm_unpacklo_epi8(two, _mm_srli_si128(two, kPlaneCount));
  return _mm256_madd_epi16(_mm256_cvtepu8_epi16(pairs), _mm256_set1_epi32(weights));
}

// r_c of one point in 1/64.
__m128i residual(const std::uint8_t* upper, std::ptrdiff_t stride, std::int32_t upper_weights,
                 std::int32_t lower_weights, const PlanePatch& patch) {
  const __m256i value =
      _mm256_add_epi32(blend_row(upper, upper_weights), blend_row(upper + stride, lower_weights));
  const __m256i rounded = _mm256_srai_epi32(_mm256_add_epi32(value, _mm256_set1_epi32(128)), 8);
  const __m128i words =
      _mm_packs_epi32(_mm256_castsi256_si128(rounded), _mm256_extracti128_si256(rounded, 1));
  const __m128i reference =
      _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(patch.reference)));
  return _mm_sub_epi16(words, _mm_slli_epi16(reference, 6));
}

__m128i products(__m128i residuals, const std::int16_t* gradients) {
  return _mm_madd_epi16(residuals, _mm_loadu_si128(reinterpret_cast<const __m128i*>(gradients)));
}

// Bits 0…7 as eight floats' masks.
__m256 mask_of(int bits) {
  const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  return _mm256_castsi256_ps(
      _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(bits), bit), bit));
}

// The three sums of eight points, each in four parts, as they come.
struct Sums {
  alignas(32) std::int32_t parts[3][kPointLanes][4];
};

// Adds up the parts of eight points, as floats.
__m256 add_parts(const std::int32_t parts[kPointLanes][4], float unit) {
  const auto pair = [parts](int i) {
    return _mm256_set_m128i(_mm_load_si128(reinterpret_cast<const __m128i*>(parts[i + 4])),
                            _mm_load_si128(reinterpret_cast<const __m128i*>(parts[i])));
  };
  const __m256i sums =
      _mm256_hadd_epi32(_mm256_hadd_epi32(pair(0), pair(1)), _mm256_hadd_epi32(pair(2), pair(3)));
  return _mm256_mul_ps(_mm256_cvtepi32_ps(sums), _mm256_set1_ps(unit));
}

}  // namespace

int sample_residuals_avx2(const TemplatePoints& points, const PointWarp& warp,
                          ImageView<const std::uint8_t> planes, const PointResiduals& out) {
  const int width = planes.width / kPlaneCount;
  const float u_end = static_cast<float>(width - 2);
  const float v_end = static_cast<float>(planes.height - 2);
  int visible = 0;
  Sums sums = {};
  for (int first = 0; first < points.count; first += kPointLanes) {
    Positions at;
    warp_8(points, first, warp, u_end, v_end, at);
    if (points.count - first < kPointLanes) at.inside &= (1 << (points.count - first)) - 1;
    for (int left = at.inside; left != 0; left &= left - 1) {
      const int k = __builtin_ctz(static_cast<unsigned>(left));
      const PlanePatch& patch = points.patches[first + k];
      const std::uint8_t* upper =
          planes.data + (at.v_q12[k] >> 12) * planes.stride + (at.u_q12[k] >> 12) * kPlaneCount;
      const __m128i r = residual(upper, planes.stride, at.upper[k], at.lower[k], patch);
      const auto put = [&sums, k](int which, __m128i value) {
        _mm_store_si128(reinterpret_cast<__m128i*>(sums.parts[which][k]), value);
      };
      put(0, products(r, patch.gx2));
      put(1, products(r, patch.gy2));
      put(2, _mm_madd_epi16(r, r));
    }
    const __m256 is_inside = mask_of(at.inside);
    const auto put = [&](float* to, int which, float unit, float outside) {
      _mm256_storeu_ps(to + first, _mm256_blendv_ps(_mm256_set1_ps(outside),
                                                    add_parts(sums.parts[which], unit), is_inside));
    };
    put(out.bx, 0, 1.0f / 128.0f, 0.0f);
    put(out.by, 1, 1.0f / 128.0f, 0.0f);
    put(out.squares, 2, 1.0f / 4096.0f, -1.0f);
    visible += __builtin_popcount(static_cast<unsigned>(at.inside));
  }
  return visible;
}

}  // namespace darkling
