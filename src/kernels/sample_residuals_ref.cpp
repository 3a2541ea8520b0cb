// SPDX-License-Identifier: Apache-2.0
#include "kernels/sample_residuals.h"

namespace darkling {

namespace {

struct Position {
  int u_q12 = 0;  // in 1/4096 px
  int v_q12 = 0;
  bool is_inside = false;
};

Position warp_point(const TemplatePoints& points, int i, const PointWarp& warp, float u_end,
                    float v_end) {
  const float* A = warp.A;
  const float f = warp.focal_px;
  const float x = points.x[i];
  const float y = points.y[i];
  const float s = points.inverse_depth_focal[i];
  const float X = A[0] * x + A[1] * y + A[2] * f + warp.a[0] * s;
  const float Y = A[3] * x + A[4] * y + A[5] * f + warp.a[1] * s;
  const float Z = A[6] * x + A[7] * y + A[8] * f + warp.a[2] * s;
  const float u = f * X / Z + warp.cx;
  const float v = f * Y / Z + warp.cy;
  // Written so that NaN, from a point in the camera's own plane, is outside.
  if (!(Z > 0.0f && u >= 1.0f && u < u_end && v >= 1.0f && v < v_end)) return {};
  return {static_cast<int>(u * 4096.0f), static_cast<int>(v * 4096.0f), true};
}

struct Weights {
  int w00, w01, w10, w11;  // in 1/16384, their sum
};

Weights bilinear_weights(const Position& p) {
  const int fx = p.u_q12 & 4095;
  const int fy = p.v_q12 & 4095;
  const int w11 = (fx * fy + 512) >> 10;
  const int w01 = 4 * fx - w11;
  const int w10 = 4 * fy - w11;
  return {16384 - 4 * fx - w10, w01, w10, w11};
}

}  // namespace

int sample_residuals_ref(const TemplatePoints& points, const PointWarp& warp,
                         ImageView<const std::uint8_t> planes, const PointResiduals& out) {
  const int width = planes.width / kPlaneCount;
  const float u_end = static_cast<float>(width - 2);
  const float v_end = static_cast<float>(planes.height - 2);
  int visible = 0;
  for (int i = 0; i < round_up_to_lanes(points.count); ++i) {
    const Position p = i < points.count ? warp_point(points, i, warp, u_end, v_end) : Position{};
    if (!p.is_inside) {
      out.bx[i] = 0.0f;
      out.by[i] = 0.0f;
      out.squares[i] = -1.0f;
      continue;
    }
    const Weights w = bilinear_weights(p);
    const std::uint8_t* upper = planes.row(p.v_q12 >> 12) + (p.u_q12 >> 12) * kPlaneCount;
    const std::uint8_t* lower = upper + planes.stride;
    const PlanePatch& patch = points.patches[i];
    int bx = 0;       // in 1/128: twice the gradient by 1/64
    int by = 0;       // 8 · 510 · 255 · 64 is below 2^27
    int squares = 0;  // in 1/4096
    for (int c = 0; c < kPlaneCount; ++c) {
      const int value = w.w00 * upper[c] + w.w01 * upper[c + kPlaneCount] + w.w10 * lower[c] +
                        w.w11 * lower[c + kPlaneCount];
      const int r = ((value + 128) >> 8) - 64 * patch.reference[c];
      bx += patch.gx2[c] * r;
      by += patch.gy2[c] * r;
      squares += r * r;
    }
    out.bx[i] = static_cast<float>(bx) * (1.0f / 128.0f);
    out.by[i] = static_cast<float>(by) * (1.0f / 128.0f);
    out.squares[i] = static_cast<float>(squares) * (1.0f / 4096.0f);
    ++visible;
  }
  return visible;
}

}  // namespace darkling
