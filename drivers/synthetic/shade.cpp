// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/shade.h"

#include <algorithm>
#include <cmath>

namespace darkling::synthetic {

Shader::Shader(const Scene& scene, const PinholeView& view, const Lamp& lamp, float footprint_px)
    : scene_(scene),
      R_(view.R_scene_camera.cast<float>()),
      p_eye_(view.p_scene),
      lamp_from_eye_((lamp.p.cast<double>() - view.p_scene).cast<float>()),
      lamp_axis_(lamp.axis) {
  const auto step = static_cast<float>(footprint_px / view.focal_px);
  step_x_ = R_.col(0) * step;
  step_y_ = R_.col(1) * step;
}

Shader::Hit Shader::intersect(const Triangle& triangle, const Vec3f& ray,
                              float inverse_depth) const {
  const Vec3f& corner = scene_.mesh.vertices[triangle.corner[0]].p;
  const Vec3f eye_to_corner = (corner.cast<double>() - p_eye_).cast<float>();
  const float towards = triangle.n.dot(ray);
  const float distance = triangle.n.dot(eye_to_corner);
  float z = distance / towards;
  // Beside a facet seen edge-on the ray may run past its plane: keep to the depth seen.
  const float ratio = z * inverse_depth;
  const bool is_sound = ratio > 0.8f && ratio < 1.25f;
  if (!is_sound) z = 1.0f / inverse_depth;
  Hit hit;
  hit.triangle = &triangle;
  hit.z = z;
  hit.to_eye_offset = z * ray;
  hit.q = hit.to_eye_offset - eye_to_corner;
  const float inverse_towards = 1.0f / std::min(towards, -1e-3f);
  hit.dx = z * (step_x_ - ray * (triangle.n.dot(step_x_) * inverse_towards));
  hit.dy = z * (step_y_ - ray * (triangle.n.dot(step_y_) * inverse_towards));
  return hit;
}

float Shader::headlight(const Vec3f& from_eye, const Vec3f& normal) const {
  const Vec3f to_lamp = lamp_from_eye_ - from_eye;
  const float d2 = to_lamp.squaredNorm();
  const float inverse_d = 1.0f / std::sqrt(d2);
  const float facing = normal.dot(to_lamp) * inverse_d;
  if (facing <= 0.0f) return 0.0f;
  // A reflector's beam: a bright core inside a wide, weak flood.
  const float c = std::max(-lamp_axis_.dot(to_lamp) * inverse_d, 0.0f);
  const float c4 = c * c * c * c;
  const float beam = 0.12f * c + 0.88f * c4 * c4;
  return scene_.headlamp.intensity * beam * facing / d2;
}

float Shader::surface(const Hit& hit) const {
  const Triangle& t = *hit.triangle;
  const Vertex& v0 = scene_.mesh.vertices[t.corner[0]];
  const Vertex& v1 = scene_.mesh.vertices[t.corner[1]];
  const Vertex& v2 = scene_.mesh.vertices[t.corner[2]];
  const float b1 = t.dual_1.dot(hit.q);
  const float b2 = t.dual_2.dot(hit.q);
  const auto blend = [b1, b2](float x0, float x1, float x2) {
    return x0 + b1 * (x1 - x0) + b2 * (x2 - x0);
  };
  // Where on the material, and how that changes along the surface (1/m · m).
  const Vec3f grad_u = t.dual_1 * (v1.u - v0.u) + t.dual_2 * (v2.u - v0.u);
  const Vec3f grad_v = t.dual_1 * (v1.v - v0.v) + t.dual_2 * (v2.v - v0.v);
  const Material& material = scene_.materials[t.material];
  const Texture& texture = scene_.textures[material.texture];
  const SurfaceSample sample = texture.sample(v0.u + grad_u.dot(hit.q), v0.v + grad_v.dot(hit.q),
                                              {grad_u.dot(hit.dx), grad_v.dot(hit.dx)},
                                              {grad_u.dot(hit.dy), grad_v.dot(hit.dy)});

  Vec3f normal = v0.n + b1 * (v1.n - v0.n) + b2 * (v2.n - v0.n);
  normal -= material.relief * (sample.slope_u * grad_u + sample.slope_v * grad_v);
  normal *= 1.0f / normal.norm();

  float irradiance = blend(v0.light, v1.light, v2.light);
  if (scene_.sun.irradiance > 0.0f) {
    const float facing = std::max(normal.dot(scene_.sun.direction), 0.0f);
    // The shadow's edge is as wide as the footprint, and at least as the sun's disc makes it.
    const float width = 0.008f + 0.5f * (hit.dx.norm() + hit.dy.norm());
    const float shadow = blend(v0.shadow_m, v1.shadow_m, v2.shadow_m);
    const float lit = std::clamp(0.5f - shadow / width, 0.0f, 1.0f);
    irradiance = irradiance * (0.6f + 0.4f * normal.z()) + scene_.sun.irradiance * facing * lit;
  }
  if (scene_.headlamp.intensity > 0.0f) irradiance += headlight(hit.to_eye_offset, normal);
  const float albedo =
      material.albedo * sample.albedo * std::max(blend(v0.tint, v1.tint, v2.tint), 0.0f);
  return albedo * std::max(irradiance, 0.0f) + material.emission;
}

float Shader::sky(const Vec3f& ray) const {
  const float up = ray.z() / ray.norm();
  const float t = smooth_step(-0.05f, 0.5f, up);
  float light = lerp(scene_.sky.horizon, scene_.sky.zenith, t);
  if (scene_.sky.cloud_texture >= 0 && up > 0.02f) {
    // A layer of cloud far above; the constant bends it down to the horizon as the Earth does.
    const float scale = 1.0f / (up + 0.12f);
    const Texture& clouds = scene_.textures[scene_.sky.cloud_texture];
    const float step = step_x_.norm() * scale;
    const SurfaceSample cover =
        clouds.sample(ray.x() * scale, ray.y() * scale, {step, 0.0f}, {0.0f, step * scale});
    light *= 0.75f + 0.5f * cover.albedo;
  }
  return light;
}

float Shader::radiance(int triangle, const Eigen::Vector2f& ray, float inverse_depth) const {
  const Vec3f direction = R_.col(0) * ray.x() + R_.col(1) * ray.y() + R_.col(2);
  if (triangle < 0) return sky(direction);
  const Hit hit = intersect(scene_.mesh.triangles[triangle], direction, inverse_depth);
  const float light = surface(hit);
  if (scene_.haze_per_m <= 0.0f) return light;
  const float clear = std::exp(-scene_.haze_per_m * hit.z);
  return light * clear + scene_.sky.horizon * (1.0f - clear);
}

}  // namespace darkling::synthetic
