// SPDX-License-Identifier: Apache-2.0
#include "vo/window_equations.h"

#include <algorithm>

#include "vo/align.h"
#include "vo/eliminate_depths.h"

namespace darkling {

namespace {

// Σ r² of a comparison below which both images show the same: 40 grey levels, root mean square over
// the planes. On the view's own scale any pose looks as good: of true comparisons a share of 0.28
// to 0.36 had e < 1, of wrong ones 0.21 to 0.35, for the scale follows the median.
constexpr float kAgreeingSquares = kPlaneCount * 40.0f * 40.0f;

// A view at the poses to try.
struct ViewGeometry {
  float eta[6];
  float tau[3];
  float inverse_scale;
  float focal_px;
};

ViewGeometry view_geometry(const Window& window, const WindowView& view, const Se3& T_later_host) {
  const Vector6 eta = (view.T_later_host.inverse() * T_later_host).log();
  const Vector3 tau = T_later_host.R().transpose() * T_later_host.translation();
  ViewGeometry geometry;
  for (int i = 0; i < 6; ++i) geometry.eta[i] = static_cast<float>(eta[i]);
  for (int i = 0; i < 3; ++i) geometry.tau[i] = static_cast<float>(tau[i]);
  geometry.inverse_scale = view.inverse_scale;
  geometry.focal_px = static_cast<float>(window.focal_px);
  return geometry;
}

// Adds what one view says about the depths of the points; writes the residuals at the present
// estimate, for the poses' share. Free of branches, and of pointers that might be the same: for the
// compiler to vectorise.
void add_view(const TemplatePoints& points, const WindowView& view, const ViewGeometry& at,
              const WindowEquations& equations, const DepthEquations& depths,
              const std::array<float*, 6>& C_of_view) {
  const float f = at.focal_px;
  const float* __restrict Sxx = points.Sxx;
  const float* __restrict Sxy = points.Sxy;
  const float* __restrict Syy = points.Syy;
  const float* __restrict squares_seen = view.residuals.squares;
  float* __restrict now_bx = equations.residuals.bx;
  float* __restrict now_by = equations.residuals.by;
  float* __restrict now_squares = equations.residuals.squares;
  float* __restrict cost = equations.cost_terms;
  float* __restrict H = depths.H;
  float* __restrict g = depths.g;
  float* __restrict agreeing = depths.agreeing;
  float* __restrict compared = depths.compared;
  float* __restrict C[6] = {C_of_view[0], C_of_view[1], C_of_view[2],
                            C_of_view[3], C_of_view[4], C_of_view[5]};
  const int count = round_up_to_lanes(points.count);
  for (int i = 0; i < count; ++i) {
    const float s = points.inverse_depth_focal[i];
    const float X = points.x[i] / f;
    const float Y = points.y[i] / f;
    const float k = 1.0f + at.tau[2] * s / f;
    const float Jsu = (at.tau[0] - X * at.tau[2]) / k;
    const float Jsv = (at.tau[1] - Y * at.tau[2]) / k;
    const float fXY = f * X * Y;
    const float fXX = f * (1.0f + X * X);
    const float fYY = f * (1.0f + Y * Y);
    const float ds = s - view.depth[i];
    const float du = Jsu * ds + s * (at.eta[0] - X * at.eta[2]) - fXY * at.eta[3] +
                     fXX * at.eta[4] - f * Y * at.eta[5];
    const float dv = Jsv * ds + s * (at.eta[1] - Y * at.eta[2]) - fYY * at.eta[3] +
                     fXY * at.eta[4] + f * X * at.eta[5];
    const float bx0 = view.residuals.bx[i];
    const float by0 = view.residuals.by[i];
    const float bx = bx0 + Sxx[i] * du + Sxy[i] * dv;
    const float by = by0 + Sxy[i] * du + Syy[i] * dv;
    const float squares = std::max(squares_seen[i] + du * (bx0 + bx) + dv * (by0 + by), 0.0f);
    const float seen = squares_seen[i] < 0.0f ? 0.0f : 1.0f;
    const float e = squares * at.inverse_scale;
    const float inverse = seen / (1.0f + e);
    const float w = inverse * inverse * at.inverse_scale;
    const float SJu = w * (Sxx[i] * Jsu + Sxy[i] * Jsv);
    const float SJv = w * (Sxy[i] * Jsu + Syy[i] * Jsv);
    now_bx[i] = bx;
    now_by[i] = by;
    now_squares[i] = squares_seen[i] < 0.0f ? -1.0f : squares;
    cost[i] += e * inverse;
    H[i] += SJu * Jsu + SJv * Jsv;
    g[i] += w * (bx * Jsu + by * Jsv);
    compared[i] += seen;
    agreeing[i] += squares < kAgreeingSquares ? seen : 0.0f;
    C[0][i] = SJu * s;
    C[1][i] = SJv * s;
    C[2][i] = -(SJu * X + SJv * Y) * s;
    C[3][i] = -(SJu * fXY + SJv * fYY);
    C[4][i] = SJu * fXX + SJv * fXY;
    C[5][i] = f * (SJv * X - SJu * Y);
  }
}

// What the points' own stereo disparities say.
void add_stereo(const WindowKeyframe& host, float* __restrict cost, DepthEquations& depths) {
  for (int i = 0; i < host.points.count; ++i) {
    const float ds = host.points.inverse_depth_focal[i] - host.stereo_depth[i];
    const float e = ds * ds * host.stereo_information[i];
    const float inverse = 1.0f / (1.0f + e);
    const float w = inverse * inverse * host.stereo_information[i];
    cost[i] += e * inverse;
    depths.H[i] += w;
    depths.g[i] += w * ds;
  }
}

void clear(int count, DepthEquations& depths) {
  const int lanes = round_up_to_lanes(count);
  for (float* array : {depths.H, depths.g, depths.agreeing, depths.compared}) {
    std::fill_n(array, lanes, 0.0f);
  }
  for (auto& later : depths.C) {
    for (float* array : later) {
      if (array != nullptr) std::fill_n(array, lanes, 0.0f);
    }
  }
}

double sum(const float* values, int count) {
  double total = 0.0;
  for (int i = 0; i < count; ++i) total += static_cast<double>(values[i]);
  return total;
}

void count_newest(const PointResiduals& now, int count, WindowEquations& equations) {
  for (int i = 0; i < count; ++i) {
    equations.seen_in_newest += now.squares[i] >= 0.0f ? 1 : 0;
    equations.agreeing_in_newest +=
        now.squares[i] >= 0.0f && now.squares[i] < kAgreeingSquares ? 1 : 0;
  }
}

void linearise_host(const KernelTable& kernels, const Window& window, int host,
                    WindowEquations& equations) {
  const WindowKeyframe& keyframe = window.keyframes()[host];
  const int count = keyframe.points.count;
  DepthEquations& depths = equations.depths[host];
  clear(count, depths);
  std::fill_n(equations.cost_terms, round_up_to_lanes(count), 0.0f);
  add_stereo(keyframe, equations.cost_terms, depths);
  RelativeEquations relative;
  relative.count = window.count - 1 - host;
  for (int later = 0; later < relative.count; ++later) {
    const Se3 T_later_host =
        window.keyframes()[host + later + 1].T_world_key.inverse() * keyframe.T_world_key;
    relative.H[later].setZero();
    relative.g[later].setZero();
    relative.Ad_host_later[later] = T_later_host.inverse().adjoint();
    const WindowView& view = keyframe.views[later];
    if (view.visible_count == 0) continue;
    add_view(keyframe.points, view, view_geometry(window, view, T_later_host), equations, depths,
             depths.C[later]);
    NormalSums sums;
    kernels.normal_equations(keyframe.points, equations.residuals,
                             static_cast<float>(window.focal_px), view.inverse_scale, sums);
    const NormalEquations motion = unpack(sums, window.focal_px);
    relative.H[later] = static_cast<double>(view.inverse_scale) * motion.H;
    relative.g[later] = static_cast<double>(view.inverse_scale) * motion.g;
    if (later + 1 == relative.count) {
      count_newest(equations.residuals, count, equations);
    }
  }
  equations.cost += sum(equations.cost_terms, count);
  // Behind the last point of a multiple of lanes, C and g are 0, and so is their product.
  for (int i = 0; i < round_up_to_lanes(count); ++i) {
    depths.H[i] = i < count ? 1.0f / depths.H[i] : 0.0f;
  }
  eliminate_depths(relative, depths, count, host, equations);
}

}  // namespace

void allocate_window_equations(const OdometryConfig& config, Arena& arena,
                               WindowEquations& equations) {
  const std::size_t lanes =
      round_up_to_lanes(std::min(config.window_points, config.points_per_level));
  const int later = config.window_keyframes - 1;
  const std::span<float> block = arena.allocate<float>(
      lanes * (4 + static_cast<std::size_t>(config.window_keyframes) * (6 + 6 * later)),
      "window equations");
  float* next = block.data();
  const auto array = [&] {
    float* first = next;
    if (next != nullptr) next += lanes;
    return first;
  };
  equations.residuals = {array(), array(), array()};
  equations.cost_terms = array();
  for (int host = 0; host < config.window_keyframes; ++host) {
    DepthEquations& depths = equations.depths[host];
    depths.H = array();
    depths.g = array();
    depths.agreeing = array();
    depths.compared = array();
    equations.at_start.depth[host] = array();
    equations.before_step.depth[host] = array();
    for (int l = 0; l < later; ++l) {
      for (float*& component : depths.C[l]) component = array();
    }
  }
  equations.H =
      arena.allocate<double>(kMaxWindowUnknowns * kMaxWindowUnknowns, "window normal equations");
}

void linearise_window(const KernelTable& kernels, const Window& window,
                      WindowEquations& equations) {
  std::fill(equations.H.begin(), equations.H.end(), 0.0);
  equations.g.fill(0.0);
  equations.cost = 0.0;
  equations.seen_in_newest = 0;
  equations.agreeing_in_newest = 0;
  for (int host = 0; host < window.count; ++host) {
    linearise_host(kernels, window, host, equations);
  }
}

void substitute_depths(const Window& window, const WindowEquations& equations, int host,
                       std::span<const Vector6> steps, std::span<float> out) {
  const DepthEquations& depths = equations.depths[host];
  std::copy_n(depths.g, out.size(), out.data());
  for (int later = 0; later + host + 1 < window.count; ++later) {
    const Se3 T_host_later = window.keyframes()[host].T_world_key.inverse() *
                             window.keyframes()[host + later + 1].T_world_key;
    const Vector6 eta = steps[host] - T_host_later.adjoint() * steps[host + later + 1];
    for (int k = 0; k < 6; ++k) {
      const float eta_k = static_cast<float>(eta[k]);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] += depths.C[later][k][i] * eta_k;
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i] *= -depths.H[i];
}

}  // namespace darkling
