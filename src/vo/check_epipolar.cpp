// SPDX-License-Identifier: Apache-2.0
#include "vo/check_epipolar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <Eigen/Cholesky>

#include "vo/area_map.h"

namespace darkling {

namespace {

constexpr int kReach = 6;  // px above and below
constexpr int kRows = 2 * kReach + 1;
constexpr int kMargin = 5;  // px from the border: patch, census and gradient stay inside
constexpr int kCell = 12;   // px; one corner each
constexpr double kMinCornerness = 300.0;  // sum of squared differences, in both directions
// Of the 392 bits of a patch half differ by chance; noise of a dim scene makes some 100 differ.
constexpr int kMostBits = 110;
// The best place wins by this factor against every other that is not next to it.
constexpr double kClearness = 1.25;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The smaller eigenvalue of the gradients' second moments over 5x5 pixels, times 25: what moves
// along an edge cannot tell a row from the next.
double cornerness(const ImageView<std::uint8_t>& grey, int x, int y) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (int j = y - 2; j <= y + 2; ++j) {
    for (int i = x - 2; i <= x + 2; ++i) {
      const double gx = 0.5 * (grey.at(i + 1, j) - grey.at(i - 1, j));
      const double gy = 0.5 * (grey.at(i, j + 1) - grey.at(i, j - 1));
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  return 0.5 * (xx + yy - std::hypot(xx - yy, 2.0 * xy));
}

std::size_t memory_bytes(const RectifiedRig& rig) {
  Arena measuring = Arena::measuring();
  (void)allocate_area_map(rig, measuring);
  (void)allocate_area_map(rig, measuring);
  (void)allocate_pyramid(rig, {1, 1, 0}, measuring);
  (void)allocate_pyramid(rig, {1, 1, 0}, measuring);
  (void)allocate_plane_scratch(rig, measuring);
  return measuring.used_bytes();
}

// Where three equally spaced values are least, relative to the middle one, by a parabola.
double sub_step(int before, int middle, int after) {
  const double curvature = before - 2.0 * middle + after;
  if (curvature <= 0.0) return 0.0;
  return std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
}

}  // namespace

EpipolarCheck::EpipolarCheck(const RectifiedRig& rig, const KernelTable& kernels)
    : rig_(rig), kernels_(kernels), arena_(memory_bytes(rig)) {}

Result<std::unique_ptr<EpipolarCheck>> EpipolarCheck::create(const StereoRig& rig, int width_px,
                                                             const KernelTable& kernels) {
  const auto rectified = rectify_rig(rig, width_px);
  if (!rectified) return tl::unexpected(rectified.error());
  std::unique_ptr<EpipolarCheck> check(new EpipolarCheck(*rectified, kernels));
  Arena& arena = check->arena_;
  const auto left_map = fill_area_map(rig.left, *rectified, rectified->R_rawleft_left,
                                      allocate_area_map(*rectified, arena));
  if (!left_map) return tl::unexpected(left_map.error());
  const auto right_map = fill_area_map(rig.right, *rectified, rectified->R_rawright_right,
                                       allocate_area_map(*rectified, arena));
  if (!right_map) return tl::unexpected(right_map.error());
  check->left_map_ = *left_map;
  check->right_map_ = *right_map;
  check->left_ = allocate_pyramid(*rectified, {1, 1, 0}, arena);
  check->right_ = allocate_pyramid(*rectified, {1, 1, 0}, arena);
  check->scratch_ = allocate_plane_scratch(*rectified, arena);
  // As far as dense stereo looks, a fifth of the width.
  check->costs_.resize(static_cast<std::size_t>(kRows) *
                       static_cast<std::size_t>(std::max(16, rectified->width / 5)));
  return check;
}

void EpipolarCheck::add(const StereoFrame& frame) {
  kernels_.remap_area(left_map_, frame.left, left_[0].grey);
  kernels_.remap_area(right_map_, frame.right, right_[0].grey);
  compute_planes(kernels_, scratch_, left_[0]);
  compute_planes(kernels_, scratch_, right_[0]);
  const int border = kMargin + kReach;
  for (int y0 = border; y0 + kCell <= rig_.height - border; y0 += kCell) {
    for (int x0 = border; x0 + kCell <= rig_.width - border; x0 += kCell) {
      int x = x0;
      int y = y0;
      if (strongest_corner_in(x0, y0, x, y) < kMinCornerness) continue;
      ++corners_;
      match_corner(x, y);
    }
  }
}

double EpipolarCheck::strongest_corner_in(int x0, int y0, int& x, int& y) const {
  double best = 0.0;
  for (int j = y0; j < y0 + kCell; j += 2) {
    for (int i = x0; i < x0 + kCell; i += 2) {
      const double found = cornerness(left_[0].grey, i, j);
      if (found <= best) continue;
      best = found;
      x = i;
      y = j;
    }
  }
  return best;
}

void EpipolarCheck::match_corner(int x, int y) {
  const int most = static_cast<int>(costs_.size()) / kRows;
  const int count = std::min(most, x - kMargin + 1);  // disparities 0 … count - 1
  const ImageView<std::uint8_t>& left = left_[0].codes;
  const ImageView<std::uint8_t>& right = right_[0].codes;
  for (int row = 0; row < kRows; ++row) {
    kernels_.match_codes(&left.at(x, y), left.stride, &right.at(x, y + row - kReach), right.stride,
                         count, &costs_[static_cast<std::size_t>(row * most)]);
  }
  const auto cost = [this, most](int row, int d) {
    return costs_[static_cast<std::size_t>(row * most + d)];
  };
  int best_row = 0;
  int best_d = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int d = 0; d < count; ++d) {
      if (cost(row, d) >= cost(best_row, best_d)) continue;
      best_row = row;
      best_d = d;
    }
  }
  const int best = cost(best_row, best_d);
  if (best > kMostBits) return;
  for (int row = 0; row < kRows; ++row) {
    for (int d = 0; d < count; ++d) {
      const bool is_near = std::abs(row - best_row) <= 1 && std::abs(d - best_d) <= 1;
      if (!is_near && cost(row, d) < kClearness * best + 4.0) return;
    }
  }
  // At the end of the reach the offset is that or more.
  const bool is_inside = best_row > 0 && best_row < kRows - 1;
  const double fraction =
      is_inside ? sub_step(cost(best_row - 1, best_d), best, cost(best_row + 1, best_d)) : 0.0;
  matches_.push_back({.u_right = x - best_d - rig_.cx,
                      .v_left = y - rig_.cy,
                      .offset = best_row - kReach + fraction});
}

// Offset = a + roll · u_right + (scale - 1) · v_left, by least squares; what is far from the first
// fit is left out of the second.
EpipolarReport EpipolarCheck::report() const {
  EpipolarReport report{.corners = corners_, .matches = static_cast<int>(matches_.size())};
  if (report.matches < kFewestEpipolarMatches) return report;
  std::vector<double> offsets;
  std::vector<double> sizes;
  for (const Match& match : matches_) {
    offsets.push_back(match.offset);
    sizes.push_back(std::abs(match.offset));
  }
  report.median_px = median_of(offsets);
  report.median_abs_px = median_of(sizes);
  Vector3 fit(report.median_px, 0.0, 0.0);
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const auto error = [&fit](const Match& match) {
      return std::abs(match.offset - fit.dot(Vector3(1.0, match.u_right, match.v_left)));
    };
    std::vector<double> errors;
    for (const Match& match : matches_) errors.push_back(error(match));
    const double most_px = 3.0 * median_of(errors) + 0.1;
    Matrix3 H = 1e-9 * Matrix3::Identity();
    Vector3 g = Vector3::Zero();
    for (const Match& match : matches_) {
      if (error(match) > most_px) continue;
      const Vector3 J(1.0, match.u_right, match.v_left);
      H += J * J.transpose();
      g += J * match.offset;
    }
    fit = H.ldlt().solve(g);
  }
  report.roll_deg = std::atan(fit.y()) * 180.0 / std::numbers::pi;
  report.scale = 1.0 + fit.z();
  return report;
}

}  // namespace darkling
