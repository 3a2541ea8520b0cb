// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include "drivers/synthetic/sensor.h"
#include "drivers/synthetic/synthetic_rig.h"

namespace darkling::synthetic {

namespace {

// Four samples a pixel, no two in the same row or column, hardly correlated with their order.
constexpr double kOffsets[kMoments][2] = {
    {-0.125, -0.375}, {0.375, 0.375}, {-0.375, 0.125}, {0.125, -0.125}};
constexpr float kFootprint_px = 0.5f;  // each stands for a quarter of the pixel's area
constexpr int kMostSamples = 16;

// What the best of lenses leaves of a point: a spot with a standard deviation of half a pixel.
// Without it the pictures would be sharper, and alias more, than any camera's.
constexpr float kSpotSide = 0.13f;

void blur_line(float* first, std::size_t stride, int count, std::vector<float>& line) {
  line.resize(static_cast<std::size_t>(count) + 2);
  for (int i = 0; i < count; ++i) line[i + 1] = first[i * stride];
  line[0] = line[1];
  line[count + 1] = line[count];
  for (int i = 0; i < count; ++i) {
    first[i * stride] =
        (1.0f - 2.0f * kSpotSide) * line[i + 1] + kSpotSide * (line[i] + line[i + 2]);
  }
}

void blur_as_a_lens(int width, int height, std::vector<float>& light, std::vector<float>& line) {
  for (int y = 0; y < height; ++y) {
    blur_line(light.data() + static_cast<std::size_t>(y) * width, 1, width, line);
  }
  for (int x = 0; x < width; ++x) {
    blur_line(light.data() + x, static_cast<std::size_t>(width), height, line);
  }
}

}  // namespace

FrameRenderer::FrameRenderer(const SyntheticSpec& spec)
    : spec_(spec),
      rig_(make_synthetic_rig(spec)),
      path_(make_path(spec)),
      scene_(make_scene(spec, path_)) {
  lenses_[0] = make_lens(rig_.left);
  lenses_[1] = make_lens(rig_.right);
}

FrameRenderer::Lens FrameRenderer::make_lens(const Camera& camera) const {
  Lens lens;
  const std::size_t count = static_cast<std::size_t>(camera.width) * camera.height;
  lens.rays.resize(count * kMoments);
  lens.nearest.resize(count * kMoments);
  lens.transmission.resize(count);
  Eigen::Array2d low(1e9, 1e9);
  Eigen::Array2d high(-1e9, -1e9);
  for (int s = 0; s < kMoments; ++s) {
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const auto ray = unproject(camera, {x + kOffsets[s][0], y + kOffsets[s][1]});
        CHECK(ray.has_value() && ray->z() > 0.1, "every pixel of the lens has a ray");
        const Eigen::Vector2d r = ray->hnormalized();
        low = low.min(r.array());
        high = high.max(r.array());
        const std::size_t i = static_cast<std::size_t>(y) * camera.width + x;
        lens.rays[s * count + i] = r.cast<float>();
        const double cosine = ray->z();
        lens.transmission[i] =
            static_cast<float>(1.0 - spec_.vignetting * (1.0 - cosine * cosine * cosine * cosine));
      }
    }
  }
  // The guide is a plain pinhole image around all rays. A distorted lens finds its facets there;
  // finer than the image, so that outlines stay within a fraction of a pixel.
  const double finer = camera.distortion == Distortion::kNone ? 1.0 : 1.5;
  PinholeView& guide = lens.guide;
  guide.focal_px = camera.fx * finer;
  guide.cx = std::ceil(-low.x() * guide.focal_px) + 1.0;
  guide.cy = std::ceil(-low.y() * guide.focal_px) + 1.0;
  guide.width = static_cast<int>(guide.cx + std::ceil(high.x() * guide.focal_px)) + 2;
  guide.height = static_cast<int>(guide.cy + std::ceil(high.y() * guide.focal_px)) + 2;
  for (std::size_t i = 0; i < lens.rays.size(); ++i) {
    const double u = lens.rays[i].x() * guide.focal_px + guide.cx;
    const double v = lens.rays[i].y() * guide.focal_px + guide.cy;
    lens.nearest[i] =
        static_cast<int>(std::lround(v)) * guide.width + static_cast<int>(std::lround(u));
  }
  return lens;
}

// More samples where the picture moves by more than ¾ px between two of them.
int FrameRenderer::sample_count(int frame) const {
  if (!spec_.blur) return kMoments;
  const double half_s = 0.5e-3 * spec_.exposure_ms;
  const Se3 moved = path_.T_scene_body(time_s(frame) - half_s).inverse() *
                    path_.T_scene_body(time_s(frame) + half_s);
  const double near_m = 1.0;
  const double px = rig_.left.fx * (rotation_angle(moved) + moved.translation().norm() / near_m);
  const int needed = static_cast<int>(std::ceil(px / 0.75 / kMoments)) * kMoments;
  return std::clamp(needed, kMoments, kMostSamples);
}

Shader::Moment FrameRenderer::make_moment(const Lens& lens, const Se3& T_body_eye, double t_s,
                                          int pattern) const {
  const Se3 T_scene_body = path_.T_scene_body(t_s);
  const Se3 T_scene_eye = T_scene_body * T_body_eye;
  Shader::Moment moment;
  PinholeView& view = moment.view;
  view = lens.guide;
  view.R_scene_camera = T_scene_eye.R();
  view.p_scene = T_scene_eye.translation();
  if (rig_.left.distortion == Distortion::kNone) {
    // Pixels of the guide are the samples themselves: shift it onto them.
    const std::size_t first = pattern * lens.transmission.size();
    const int column = lens.nearest[first] % view.width;
    const int row = lens.nearest[first] / view.width;
    view.cx = column - lens.rays[first].x() * view.focal_px;
    view.cy = row - lens.rays[first].y() * view.focal_px;
  }
  moment.lamp = (T_scene_body * scene_.headlamp.p_body.cast<double>()).cast<float>();
  moment.lamp_axis = (T_scene_body.R() * scene_.headlamp.axis_body.cast<double>()).cast<float>();
  return moment;
}

void FrameRenderer::add_samples(const Lens& lens,
                                const std::array<Shader::Moment, kMoments>& moments,
                                Scratch& scratch) const {
  for (int k = 0; k < kMoments; ++k) {
    find_visible(scene_.mesh, moments[k].view, scratch.visible[k], scratch.projected);
  }
  const Shader shader(scene_, moments, kFootprint_px);
  const std::size_t count = lens.transmission.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::array<PixelSample, kMoments> samples;
    std::array<std::int32_t, kMoments> seen;
    for (int k = 0; k < kMoments; ++k) {
      const std::size_t at = lens.nearest[k * count + i];
      seen[k] = scratch.visible[k].triangle[at];
      samples[k] = {k, lens.rays[k * count + i], scratch.visible[k].inverse_depth[at]};
    }
    // Samples of the same facet are shaded together.
    for (int first = 0; first < kMoments;) {
      int end = first + 1;
      for (int k = end; k < kMoments; ++k) {
        if (seen[k] != seen[first]) continue;
        std::swap(seen[k], seen[end]);
        std::swap(samples[k], samples[end]);
        ++end;
      }
      const std::span<const PixelSample> same(samples.data() + first, samples.data() + end);
      scratch.light[i] += static_cast<float>(end - first) * shader.radiance(seen[first], same);
      first = end;
    }
  }
}

std::span<const float> FrameRenderer::render_light(int frame, Eye eye, Scratch& scratch) const {
  const Lens& lens = lenses_[static_cast<int>(eye)];
  const Se3& T_body_eye = eye == Eye::kLeft ? rig_.T_body_rawleft : rig_.T_body_rawright;
  const int samples = sample_count(frame);
  const double open_s = spec_.blur ? 1e-3 * spec_.exposure_ms : 0.0;
  scratch.light.assign(lens.transmission.size(), 0.0f);
  for (int first = 0; first < samples; first += kMoments) {
    std::array<Shader::Moment, kMoments> moments;
    for (int k = 0; k < kMoments; ++k) {
      // The moments of a batch are spread over the whole exposure, between those of the others.
      const int order = k * (samples / kMoments) + first / kMoments;
      const double t_s = time_s(frame) + open_s * ((order + 0.5) / samples - 0.5);
      moments[k] = make_moment(lens, T_body_eye, t_s, k);
    }
    add_samples(lens, moments, scratch);
  }
  const float scale = 1.0f / (static_cast<float>(samples) * scene_.middle_grey);
  for (std::size_t i = 0; i < scratch.light.size(); ++i) {
    scratch.light[i] *= scale * lens.transmission[i];
  }
  const Camera& camera = eye == Eye::kLeft ? rig_.left : rig_.right;
  blur_as_a_lens(camera.width, camera.height, scratch.light, scratch.row);
  return scratch.light;
}

void FrameRenderer::render(int frame, Eye eye, Scratch& scratch,
                           ImageView<std::uint8_t> image) const {
  const std::span<const float> light = render_light(frame, eye, scratch);
  const Sensor sensor = make_sensor(spec_);
  const std::uint64_t eye_key =
      mix64(spec_.seed * 4 + static_cast<std::uint64_t>(eye)) + static_cast<std::uint64_t>(frame);
  const std::uint64_t key = mix64(eye_key);
  for (int y = 0; y < image.height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * image.width;
    expose(sensor, light.subspan(first, image.width), key + first,
           {image.row(y), static_cast<std::size_t>(image.width)});
  }
}

double FrameRenderer::nearest_hit(std::span<const Triangle> triangles, const Vector3& origin,
                                  const Vector3& direction, double nearest_m) const {
  for (const Triangle& t : triangles) {
    const Vector3 n = t.n.cast<double>();
    const double towards = n.dot(direction);
    if (towards >= 0.0) continue;
    const Vector3 corner = scene_.mesh.vertices[t.corner[0]].p.cast<double>();
    const double distance = n.dot(corner - origin) / towards;
    if (distance <= 0.0 || distance >= nearest_m) continue;
    const Vector3 q = origin + distance * direction - corner;
    const double b1 = q.dot(t.dual_1.cast<double>());
    const double b2 = q.dot(t.dual_2.cast<double>());
    if (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) nearest_m = distance;
  }
  return nearest_m;
}

std::optional<Vector3> FrameRenderer::surface_point(double t_s, Eye eye,
                                                    const Eigen::Vector2d& pixel) const {
  const bool is_left = eye == Eye::kLeft;
  const auto ray = unproject(is_left ? rig_.left : rig_.right, pixel);
  if (!ray) return std::nullopt;
  const Se3 T_scene_eye =
      path_.T_scene_body(t_s) * (is_left ? rig_.T_body_rawleft : rig_.T_body_rawright);
  const Vector3& origin = T_scene_eye.translation();
  const Vector3 direction = T_scene_eye.R() * *ray;
  double nearest = 1e9;
  for (const Chunk& chunk : scene_.mesh.chunks) {
    const Vector3 to_chunk = chunk.centre.cast<double>() - origin;
    const double beside_m = to_chunk.cross(direction).norm();
    if (beside_m > 1.001 * chunk.radius_m) continue;
    const Triangle* first = scene_.mesh.triangles.data() + chunk.first_triangle;
    nearest = nearest_hit({first, static_cast<std::size_t>(chunk.triangle_count)}, origin,
                          direction, nearest);
  }
  if (nearest >= 1e9) return std::nullopt;
  return origin + nearest * direction;
}

}  // namespace darkling::synthetic
