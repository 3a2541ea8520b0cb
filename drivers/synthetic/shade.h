// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "drivers/synthetic/scene.h"
#include "drivers/synthetic/visibility.h"

namespace darkling::synthetic {

inline constexpr int kMoments = 4;

// One of the samples of a pixel.
struct PixelSample {
  int moment = 0;
  Eigen::Vector2f ray;         // (x, y, 1) in the camera's frame
  float inverse_depth = 0.0f;  // as find_visible() saw it nearby, 1/m
};

// Computes the light that comes to one eye at four moments of an exposure.
class Shader {
 public:
  struct Moment {
    PinholeView view;            // pose and focal length
    Vec3f lamp = Vec3f::Zero();  // where the headlamp is and where it points, scene frame
    Vec3f lamp_axis = Vec3f::UnitX();
  };
  // @param footprint_px  the part of a pixel's width that one sample stands for.
  Shader(const Scene& scene, const std::array<Moment, kMoments>& moments, float footprint_px);

  // The mean radiance along rays that all meet `triangle` (-1: the sky). Each ray meets the facet's
  // plane and reads the material there on its own; light and shade are computed once.
  // @pre 1…kMoments samples.
  [[nodiscard]] float radiance(int triangle, std::span<const PixelSample> samples) const;

 private:
  struct Eye {
    Eigen::Matrix3f R;
    Eigen::Vector3d p;
    Vec3f step_x, step_y;  // of a ray over half a footprint
  };
  // What the samples found on the facet, summed up.
  struct Patch {
    Vec3f q = Vec3f::Zero();  // from corner 0, m; mean
    Vec3f normal = Vec3f::UnitZ();
    float albedo = 0.0f;
    float depth_m = 0.0f;
    float width_m = 0.0f;  // of the footprint
    float b1 = 0.0f;       // barycentric weights
    float b2 = 0.0f;
  };
  [[nodiscard]] Vec3f direction(const PixelSample& sample) const;
  [[nodiscard]] Patch gather(const Triangle& t, std::span<const PixelSample> samples) const;
  [[nodiscard]] float lit(const Triangle& t, const Patch& patch) const;
  [[nodiscard]] float headlight(const Vec3f& p, const Vec3f& normal) const;
  [[nodiscard]] float sky(const Vec3f& ray) const;

  const Scene& scene_;
  std::array<Eye, kMoments> eyes_;
  Vec3f lamp_;
  Vec3f lamp_axis_;
};

}  // namespace darkling::synthetic
