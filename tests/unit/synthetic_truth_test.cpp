// SPDX-License-Identifier: Apache-2.0
// The truth that the scenes come with, tested by what the pictures show.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/synthetic/frame_renderer.h"
#include "drivers/synthetic/sensor.h"

namespace darkling::synthetic {
namespace {

SyntheticSpec spec_of(const std::string& scene) {
  SyntheticSpec spec;
  spec.scene = scene;
  spec.frames = 40;
  spec.width = 240;
  spec.vignetting = 0.0;  // the same surface at two places of the picture is as bright
  EXPECT_TRUE(check_synthetic(spec).has_value());
  return spec;
}

using Picture = std::vector<float>;

Picture take(const FrameRenderer& renderer, int frame, Eye eye) {
  FrameRenderer::Scratch scratch;
  const auto light = renderer.render_light(frame, eye, scratch);
  return {light.begin(), light.end()};
}

// Bilinear; negative outside.
float look_up(const Picture& picture, const Camera& camera, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  if (x < 0 || y < 0 || x + 1 >= camera.width || y + 1 >= camera.height) return -1.0f;
  const auto a = static_cast<float>(at.x() - x);
  const auto b = static_cast<float>(at.y() - y);
  const float* p = picture.data() + static_cast<std::size_t>(y) * camera.width + x;
  return lerp(lerp(p[0], p[1], a), lerp(p[camera.width], p[camera.width + 1], a), b);
}

struct SeenPoint {
  Vector3 p_scene;
  float light;
};

// Points on a grid of the left picture of `frame`, away from its border.
std::vector<SeenPoint> see_points(const FrameRenderer& renderer, int frame) {
  const Picture picture = take(renderer, frame, Eye::kLeft);
  const Camera& camera = renderer.rig().left;
  std::vector<SeenPoint> points;
  for (int y = 14; y + 14 < camera.height; y += 17) {
    for (int x = 40; x + 14 < camera.width; x += 17) {
      const auto p =
          renderer.surface_point(renderer.time_s(frame), Eye::kLeft, Eigen::Vector2d(x, y));
      if (p) points.push_back({*p, picture[static_cast<std::size_t>(y) * camera.width + x]});
    }
  }
  return points;
}

// The median difference of light where `other`, a picture by `camera` at T_scene_camera, shows the
// points. Robust against the few that something hides there.
double median_difference(const std::vector<SeenPoint>& points, const Picture& other,
                         const Camera& camera, const Se3& T_scene_camera) {
  std::vector<double> differences;
  for (const SeenPoint& point : points) {
    const Vector3 p = T_scene_camera.inverse() * point.p_scene;
    if (p.z() <= 0.1) continue;
    const float light = look_up(other, camera, project(camera, p));
    if (light >= 0.0f) differences.push_back(std::abs(light - point.light));
  }
  EXPECT_GT(differences.size(), 40u);
  std::nth_element(differences.begin(), differences.begin() + differences.size() / 2,
                   differences.end());
  return differences[differences.size() / 2];
}

void expect_eyes_agree(const SyntheticSpec& spec) {
  const FrameRenderer renderer(spec);
  const int frame = 20;
  const auto points = see_points(renderer, frame);
  const Picture right = take(renderer, frame, Eye::kRight);
  const Se3 T_scene_body = renderer.T_scene_body(renderer.time_s(frame));
  const Se3 T = T_scene_body * renderer.rig().T_body_rawright;
  const double at_truth = median_difference(points, right, renderer.rig().right, T);
  EXPECT_LT(at_truth, 0.01) << spec.scene;  // 1 % of mid-grey
  // Half a degree beside it is not the same place.
  const Se3 turned = T * Se3(so3_exp({0.0, 0.009, 0.0}), Vector3::Zero());
  EXPECT_GT(median_difference(points, right, renderer.rig().right, turned), 1.5 * at_truth)
      << spec.scene;
}

TEST(SyntheticTruth, BothEyesSeeTheSameSurface) {
  for (const char* scene : {"mine", "corridor"}) expect_eyes_agree(spec_of(scene));
}

TEST(SyntheticTruth, HoldsWithALensThatDistortsAndARolledCamera) {
  SyntheticSpec spec = spec_of("corridor");
  spec.distortion = 1.0;
  spec.roll_right_deg = 1.5;
  expect_eyes_agree(spec);
}

// The sum of squared differences between consecutive frames is least at the true motion, within
// 2 mm and 0.05° in every direction.
TEST(SyntheticTruth, MotionIsWhatThePicturesShow) {
  for (const char* scene : {"quarry", "corridor"}) {
    const FrameRenderer renderer(spec_of(scene));
    const int frame = 12;
    const Picture next = take(renderer, frame + 1, Eye::kLeft);
    const Picture now = take(renderer, frame, Eye::kLeft);
    const Camera& camera = renderer.rig().left;
    std::vector<SeenPoint> points;
    for (int y = 8; y + 8 < camera.height; y += 3) {
      for (int x = 8; x + 8 < camera.width; x += 3) {
        const auto p =
            renderer.surface_point(renderer.time_s(frame), Eye::kLeft, Eigen::Vector2d(x, y));
        if (p) points.push_back({*p, now[static_cast<std::size_t>(y) * camera.width + x]});
      }
    }
    const Se3 T = renderer.T_scene_body(renderer.time_s(frame + 1)) * renderer.rig().T_body_rawleft;
    const auto cost = [&](const Vector6& xi) {
      double sum = 0.0;
      for (const SeenPoint& point : points) {
        const Vector3 p = plus(T, xi).inverse() * point.p_scene;
        const float light = p.z() > 0.1 ? look_up(next, camera, project(camera, p)) : -1.0f;
        if (light >= 0.0f) sum += std::min(std::abs(light - point.light), 0.2f);
      }
      return sum;
    };
    const double at_truth = cost(Vector6::Zero());
    for (int axis = 0; axis < 6; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Vector6 xi = Vector6::Zero();
        xi[axis] = sign * (axis < 3 ? 0.002 : 0.05 * 0.0174533);
        EXPECT_LT(at_truth, cost(xi)) << scene << " axis " << axis << " sign " << sign;
      }
    }
  }
}

TEST(SyntheticTruth, LevelsFollowExposureAndGain) {
  SyntheticSpec spec = spec_of("corridor");
  const auto mean = [&spec](double exposure_ms, double gain) {
    spec.exposure_ms = exposure_ms;
    spec.gain = gain;
    const Sensor sensor = make_sensor(spec);
    const std::vector<float> row(20000, 0.6f);
    std::vector<std::uint8_t> levels(row.size());
    expose(sensor, row, 1, levels);
    double sum = 0.0;
    for (std::uint8_t level : levels) sum += level - kBlackLevel;
    return sum / static_cast<double>(levels.size());
  };
  EXPECT_NEAR(mean(5.0, 1.0), 0.6 * kMiddleLevel, 0.2);
  EXPECT_NEAR(mean(2.5, 1.0), 0.3 * kMiddleLevel, 0.2);
  EXPECT_NEAR(mean(2.5, 3.0), 0.9 * kMiddleLevel, 0.2);
}

}  // namespace
}  // namespace darkling::synthetic
