// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/shade.h"

#include <algorithm>
#include <cmath>

namespace darkling::synthetic {

Shader::Shader(const Scene& scene, const std::array<Moment, kMoments>& moments, float footprint_px)
    : scene_(scene), lamp_(Vec3f::Zero()), lamp_axis_(Vec3f::Zero()) {
  for (int i = 0; i < kMoments; ++i) {
    const PinholeView& view = moments[i].view;
    const auto step = static_cast<float>(footprint_px / view.focal_px);
    Eye& eye = eyes_[i];
    eye.R = view.R_scene_camera.cast<float>();
    eye.p = view.p_scene;
    eye.step_x = eye.R.col(0) * step;
    eye.step_y = eye.R.col(1) * step;
    lamp_ += moments[i].lamp / kMoments;
    lamp_axis_ += moments[i].lamp_axis / kMoments;
  }
}

Vec3f Shader::direction(const PixelSample& sample) const {
  const Eigen::Matrix3f& R = eyes_[sample.moment].R;
  return R.col(0) * sample.ray.x() + R.col(1) * sample.ray.y() + R.col(2);
}

Shader::Patch Shader::gather(const Triangle& t, std::span<const PixelSample> samples) const {
  const std::vector<Vertex>& vertices = scene_.mesh.vertices;
  const Vertex& v0 = vertices[t.corner[0]];
  const Vertex& v1 = vertices[t.corner[1]];
  const Vertex& v2 = vertices[t.corner[2]];
  // Where on the material: (u, v) is linear over the facet.
  const Vec3f grad_u = t.dual_1 * (v1.u - v0.u) + t.dual_2 * (v2.u - v0.u);
  const Vec3f grad_v = t.dual_1 * (v1.v - v0.v) + t.dual_2 * (v2.v - v0.v);
  const Material& material = scene_.materials[t.material];
  const Texture& texture = scene_.textures[material.texture];
  Patch patch;
  Footprint footprint;
  float slope_u = 0.0f;
  float slope_v = 0.0f;
  const float weight = 1.0f / static_cast<float>(samples.size());
  for (const PixelSample& sample : samples) {
    const Eye& eye = eyes_[sample.moment];
    const Vec3f ray = direction(sample);
    const Vec3f to_corner = (v0.p.cast<double>() - eye.p).cast<float>();
    const float towards = t.n.dot(ray);
    float z = t.n.dot(to_corner) / towards;
    // Beside a facet seen edge-on the ray may run past its plane: keep to the depth seen.
    const float ratio = z * sample.inverse_depth;
    if (!(ratio > 0.8f && ratio < 1.25f)) z = 1.0f / sample.inverse_depth;
    const Vec3f q = z * ray - to_corner;
    if (patch.depth_m == 0.0f) {
      const Vec3f slide = ray * (1.0f / std::min(towards, -1e-3f));
      const Vec3f dx = z * (eye.step_x - slide * t.n.dot(eye.step_x));
      const Vec3f dy = z * (eye.step_y - slide * t.n.dot(eye.step_y));
      footprint =
          texture.footprint({grad_u.dot(dx), grad_v.dot(dx)}, {grad_u.dot(dy), grad_v.dot(dy)});
      patch.depth_m = z;
      patch.width_m = std::abs(dx.x()) + std::abs(dx.y()) + std::abs(dx.z()) + std::abs(dy.x()) +
                      std::abs(dy.y()) + std::abs(dy.z());
    }
    const SurfaceSample found =
        texture.sample(v0.u + grad_u.dot(q), v0.v + grad_v.dot(q), footprint);
    patch.q += weight * q;
    patch.albedo += weight * found.albedo;
    slope_u += weight * found.slope_u;
    slope_v += weight * found.slope_v;
  }
  patch.b1 = t.dual_1.dot(patch.q);
  patch.b2 = t.dual_2.dot(patch.q);
  patch.normal = v0.n + patch.b1 * (v1.n - v0.n) + patch.b2 * (v2.n - v0.n) -
                 material.relief * (slope_u * grad_u + slope_v * grad_v);
  patch.normal *= 1.0f / patch.normal.norm();
  return patch;
}

float Shader::headlight(const Vec3f& p, const Vec3f& normal) const {
  const Vec3f to_lamp = lamp_ - p;
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

float Shader::lit(const Triangle& t, const Patch& patch) const {
  const Vertex& v0 = scene_.mesh.vertices[t.corner[0]];
  const Vertex& v1 = scene_.mesh.vertices[t.corner[1]];
  const Vertex& v2 = scene_.mesh.vertices[t.corner[2]];
  const auto blend = [&patch](float x0, float x1, float x2) {
    return x0 + patch.b1 * (x1 - x0) + patch.b2 * (x2 - x0);
  };
  float irradiance = blend(v0.light, v1.light, v2.light);
  if (scene_.sun.irradiance > 0.0f) {
    const float facing = std::max(patch.normal.dot(scene_.sun.direction), 0.0f);
    // The shadow's edge is as wide as the footprint, and at least as the sun's disc makes it.
    const float width = 0.008f + 0.5f * patch.width_m;
    const float shadow = blend(v0.shadow_m, v1.shadow_m, v2.shadow_m);
    const float in_sun = std::clamp(0.5f - shadow / width, 0.0f, 1.0f);
    irradiance =
        irradiance * (0.6f + 0.4f * patch.normal.z()) + scene_.sun.irradiance * facing * in_sun;
  }
  if (scene_.headlamp.intensity > 0.0f) irradiance += headlight(v0.p + patch.q, patch.normal);
  const Material& material = scene_.materials[t.material];
  const float tint = std::max(blend(v0.tint, v1.tint, v2.tint), 0.0f);
  return material.albedo * patch.albedo * tint * std::max(irradiance, 0.0f) + material.emission;
}

float Shader::sky(const Vec3f& ray) const {
  if (scene_.sky.zenith <= 0.0f) return 0.0f;
  const float up = ray.z() / ray.norm();
  float light = lerp(scene_.sky.horizon, scene_.sky.zenith, smooth_step(-0.05f, 0.5f, up));
  if (scene_.sky.cloud_texture >= 0 && up > 0.0f) {
    // A layer of cloud far above; the constant bends it down to the horizon as the Earth does.
    const float scale = 1.0f / (up + 0.12f);
    const Texture& clouds = scene_.textures[scene_.sky.cloud_texture];
    const float step = eyes_[0].step_x.norm() * scale;
    const SurfaceSample cover = clouds.sample(ray.x() * scale, ray.y() * scale,
                                              clouds.footprint({step, 0.0f}, {0.0f, step * scale}));
    light *= 0.75f + 0.5f * cover.albedo * smooth_step(0.0f, 0.15f, up);
  }
  return light;
}

float Shader::radiance(int triangle, std::span<const PixelSample> samples) const {
  if (triangle < 0) {
    float light = 0.0f;
    for (const PixelSample& sample : samples) light += sky(direction(sample));
    return light / static_cast<float>(samples.size());
  }
  const Triangle& t = scene_.mesh.triangles[triangle];
  const Patch patch = gather(t, samples);
  const float light = lit(t, patch);
  if (scene_.haze_per_m <= 0.0f) return light;
  // Near enough to exp(-x) where there is anything to see, and without the call.
  const float clear = 1.0f / (1.0f + scene_.haze_per_m * patch.depth_m);
  return light * clear + scene_.sky.horizon * (1.0f - clear);
}

}  // namespace darkling::synthetic
