// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "kernels/sample_residuals.h"

namespace darkling {

int sample_residuals_ref(std::span<const TemplatePoint> points, const PointWarp& warp,
                         ImageView<const std::uint8_t> planes, std::span<PointResidual> out) {
  const auto& A = warp.A;
  const auto& a = warp.a;
  const float f = warp.focal_px;
  const int width = planes.width / kPlaneCount;
  const float u_end = static_cast<float>(width - 2);
  const float v_end = static_cast<float>(planes.height - 2);
  int visible = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TemplatePoint& p = points[i];
    const float s = p.inverse_depth_focal;
    const float X = A[0] * p.x + A[1] * p.y + A[2] * f + a[0] * s;
    const float Y = A[3] * p.x + A[4] * p.y + A[5] * f + a[1] * s;
    const float Z = A[6] * p.x + A[7] * p.y + A[8] * f + a[2] * s;
    const float u = f * X / Z + warp.cx;
    const float v = f * Y / Z + warp.cy;
    out[i] = PointResidual{};
    // Written so that NaN, from a point in the camera's own plane, is outside.
    if (!(Z > 0.0f && u >= 1.0f && u < u_end && v >= 1.0f && v < v_end)) continue;
    const int u0 = static_cast<int>(u);
    const int v0 = static_cast<int>(v);
    const float du = u - static_cast<float>(u0);
    const float dv = v - static_cast<float>(v0);
    const float w11 = du * dv;
    const float w10 = dv - w11;
    const float w01 = du - w11;
    const float w00 = 1.0f - du - w10;
    const std::uint8_t* upper = planes.row(v0) + u0 * kPlaneCount;
    const std::uint8_t* lower = upper + planes.stride;
    float bx = 0.0f;
    float by = 0.0f;
    float squares = 0.0f;
    for (int c = 0; c < kPlaneCount; ++c) {
      const float value =
          w00 * static_cast<float>(upper[c]) + w01 * static_cast<float>(upper[c + kPlaneCount]) +
          w10 * static_cast<float>(lower[c]) + w11 * static_cast<float>(lower[c + kPlaneCount]);
      const float r = value - static_cast<float>(p.reference[c]);
      bx += static_cast<float>(p.gx2[c]) * r;
      by += static_cast<float>(p.gy2[c]) * r;
      squares += r * r;
    }
    out[i] = {0.5f * bx, 0.5f * by, std::sqrt(squares / kPlaneCount)};
    ++visible;
  }
  return visible;
}

}  // namespace darkling
