// SPDX-License-Identifier: Apache-2.0
#include "vo/carry_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/stereo_rig.h"

namespace darkling {

namespace {

constexpr float kMinInlierRatio = 0.5f;
constexpr float kMaxSigmas = 3.0f;  // between two disparities of one point
// A neighbour's disparity is this much less certain for each pixel it lies away: a slope that is
// common on floors and walls.
constexpr float kSlope = 0.1f;

static_assert(kMaxWindowKeyframes * kMaxWindowPoints < std::numeric_limits<std::uint16_t>::max());

// A point of the window as the new keyframe should see it.
struct CarriedPoint {
  float u = 0.0f;  // px
  float v = 0.0f;
  float disparity_px = 0.0f;
  float variance_px2 = 0.0f;
};

class Projection {
 public:
  Projection(const Window& window, const Se3& T_world_key, const PyramidLevel& level)
      : window_(window), level_(level) {
    const Se3 T_key_world = T_world_key.inverse();
    for (int h = 0; h < window.count; ++h) {
      const Se3 T_key_host = T_key_world * window.keyframes()[h].T_world_key;
      R_[h] = T_key_host.R().cast<float>();
      t_[h] = T_key_host.translation().cast<float>();
    }
  }

  // @param number  h · kMaxWindowPoints + index.
  [[nodiscard]] std::optional<CarriedPoint> operator()(int number) const {
    const int h = number / kMaxWindowPoints;
    const int i = number % kMaxWindowPoints;
    const WindowKeyframe& host = window_.keyframes()[h];
    if (host.inlier_ratio[i] < kMinInlierRatio) return std::nullopt;
    const auto f = static_cast<float>(window_.focal_px);
    const auto b = static_cast<float>(window_.baseline_m);
    const float s = host.points.inverse_depth_focal[i];
    const Eigen::Vector3f q =
        R_[h] * Eigen::Vector3f(host.points.x[i], host.points.y[i], f) + t_[h] * s;
    const float u = f * q.x() / q.z() + static_cast<float>(level_.cx);
    const float v = f * q.y() / q.z() + static_cast<float>(level_.cy);
    const bool is_inside = q.z() > 0.0f && u >= 0.0f &&
                           u < static_cast<float>(level_.grey.width - 1) && v >= 0.0f &&
                           v < static_cast<float>(level_.grey.height - 1);
    if (!is_inside) return std::nullopt;  // also what is no number
    const float disparity = b * s * f / q.z();
    // The derivative of d / b = s f / q_z, with q_z = (R (x, y, f))_z + t_z s.
    const float gain = f * (q.z() - t_[h].z() * s) / (q.z() * q.z());
    return CarriedPoint{u, v, disparity,
                        gain * gain * b * b * kCostOfInformation / host.information[i]};
  }

 private:
  const Window& window_;
  const PyramidLevel& level_;
  std::array<Eigen::Matrix3f, kMaxWindowKeyframes> R_;
  std::array<Eigen::Vector3f, kMaxWindowKeyframes> t_;
};

// Later keyframes write over earlier ones: they have seen the point from nearer by.
void mark_points(const Window& window, const Projection& project, const PointImage& image) {
  for (int y = 0; y < image.height; ++y) std::fill_n(image.row(y), image.width, std::uint16_t{0});
  for (int h = 0; h < window.count; ++h) {
    for (int i = 0; i < window.keyframes()[h].points.count; ++i) {
      const int number = h * kMaxWindowPoints + i;
      const std::optional<CarriedPoint> point = project(number);
      if (!point) continue;
      image.at(static_cast<int>(std::lround(point->u)), static_cast<int>(std::lround(point->v))) =
          static_cast<std::uint16_t>(number + 1);
    }
  }
}

// The marked point nearest to a pixel, of those in its eight neighbours and itself.
std::optional<CarriedPoint> nearest_point(const PointImage& image, const Projection& project, int x,
                                          int y) {
  std::optional<CarriedPoint> nearest;
  float least = std::numeric_limits<float>::max();
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
      if (image.at(u, v) == 0) continue;
      std::optional<CarriedPoint> point = project(image.at(u, v) - 1);
      const float du = point->u - static_cast<float>(x);
      const float dv = point->v - static_cast<float>(y);
      const float distance_squared = du * du + dv * dv;
      if (distance_squared >= least) continue;
      least = distance_squared;
      nearest = point;
      nearest->variance_px2 += kSlope * kSlope * distance_squared;
    }
  }
  return nearest;
}

}  // namespace

PointImage allocate_point_image(const RectifiedRig& rig, Arena& arena) {
  return arena.allocate_image<std::uint16_t>(rig.width, rig.height, "points of the window");
}

int carry_depths(const Window& window, const Se3& T_world_key, const PyramidLevel& level,
                 std::span<const PointSelector::Candidate> measured, const PointImage& scratch,
                 TemplatePoints& points) {
  if (window.count == 0) return 0;
  const Projection project(window, T_world_key, level);
  mark_points(window, project, scratch);
  int fused = 0;
  for (int i = 0; i < points.count; ++i) {
    const PointSelector::Candidate& c = measured[i];
    const std::optional<CarriedPoint> carried = nearest_point(scratch, project, c.x, c.y);
    if (!carried) continue;
    const float difference = carried->disparity_px - c.disparity_px;
    const float variance = carried->variance_px2 + c.variance_px2;
    if (difference * difference > kMaxSigmas * kMaxSigmas * variance) continue;
    const float disparity = c.disparity_px + difference * c.variance_px2 / variance;
    points.inverse_depth_focal[i] = disparity / static_cast<float>(window.baseline_m);
    ++fused;
  }
  return fused;
}

}  // namespace darkling
