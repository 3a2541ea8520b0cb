// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drivers/synthetic/scene.h"
#include "drivers/synthetic/visibility.h"

namespace darkling::synthetic {

// Computes the light that comes to one eye at one moment.
class Shader {
 public:
  // @param view   the eye; only its pose and focal length (the size of a footprint) matter.
  // @param lamp   where the headlamp is and where it points, scene frame.
  struct Lamp {
    Vec3f p = Vec3f::Zero();
    Vec3f axis = Vec3f::UnitX();
  };
  // @param footprint_px  the part of a pixel's width that one sample stands for.
  Shader(const Scene& scene, const PinholeView& view, const Lamp& lamp, float footprint_px);

  // Radiance along the ray (x, y, 1) of the camera's frame, from where it meets the plane of
  // `triangle`, or from the sky when that is -1.
  // @param inverse_depth  as find_visible() saw it nearby: stands in where the ray runs along the
  //                       facet.
  [[nodiscard]] float radiance(int triangle, const Eigen::Vector2f& ray, float inverse_depth) const;

 private:
  struct Hit {
    const Triangle* triangle;
    Vec3f q;              // from corner 0, m
    Vec3f to_eye_offset;  // from the eye, m
    Vec3f dx, dy;         // how it moves over half the footprint
    float z;              // depth, m
  };
  [[nodiscard]] Hit intersect(const Triangle& triangle, const Vec3f& ray,
                              float inverse_depth) const;
  [[nodiscard]] float surface(const Hit& hit) const;
  [[nodiscard]] float headlight(const Vec3f& from_eye, const Vec3f& normal) const;
  [[nodiscard]] float sky(const Vec3f& ray) const;

  const Scene& scene_;
  Eigen::Matrix3f R_;
  Eigen::Vector3d p_eye_;
  Vec3f step_x_, step_y_;  // of a ray over half a footprint
  Vec3f lamp_from_eye_;
  Vec3f lamp_axis_;
};

}  // namespace darkling::synthetic
