// SPDX-License-Identifier: Apache-2.0
#include "support/window_stages.h"

#include <cmath>

namespace darkling::test {

namespace {

OdometryConfig config_of(const WindowStages::Layout& layout) {
  OdometryConfig config;
  config.window_keyframes = layout.keyframes;
  config.window_points = layout.points;
  return config;
}

}  // namespace

Se3 motion(double x, double y, double z, double rx, double ry, double rz) {
  Vector6 xi;
  xi << x, y, z, rx, ry, rz;
  return Se3::exp(xi);
}

std::vector<double> estimate_of(const Window& window) {
  std::vector<double> numbers;
  for (const WindowKeyframe& keyframe : window.keyframes()) {
    const Eigen::Vector4d q = keyframe.T_world_key.rotation().coeffs();
    numbers.insert(numbers.end(), q.data(), q.data() + 4);
    const Vector3& t = keyframe.T_world_key.translation();
    numbers.insert(numbers.end(), t.data(), t.data() + 3);
    for (const float* array : {keyframe.points.inverse_depth_focal, keyframe.stereo_depth,
                               keyframe.information, keyframe.inlier_ratio}) {
      numbers.insert(numbers.end(), array, array + keyframe.points.count);
    }
  }
  return numbers;
}

double image_motion_px(const Window& window, const WindowKeyframe& keyframe, const Se3& T_world_old,
                       const Se3& T_world_new) {
  const TemplatePoints& points = keyframe.points;
  const Se3 T_new_old = T_world_new.inverse() * T_world_old;
  const double f = window.focal_px;
  double sum = 0.0;
  for (int i = 0; i < points.count; ++i) {
    const Vector3 q = T_new_old.rotation() * Vector3(points.x[i], points.y[i], f) +
                      T_new_old.translation() * double(points.inverse_depth_focal[i]);
    sum += (f / q.z() * q.head<2>() - Eigen::Vector2d(points.x[i], points.y[i])).squaredNorm();
  }
  return std::sqrt(sum / points.count);
}

WindowStages::WindowStages(const RectifiedRig& rig, const Layout& layout)
    : rig_(rig), layout_(layout), arena_(8u << 20), eye_(rig, 1), template_(rig, 1, layout.points) {
  allocate_window(rig, config_of(layout), arena_, window_);
  allocate_window_equations(config_of(layout), arena_, equations_);
}

void WindowStages::add(const PlaneWorld& world, const Se3& T_world_true, const Se3& T_world_key) {
  world.render(rig_, T_world_true, eye_.grey());
  template_.know_disparities(world, T_world_true);
  add_seen(T_world_key);
}

void WindowStages::add_seen(const Se3& T_world_key) {
  eye_.prepare(kernels_);
  const PyramidLevel& level = eye_.pyramid()[0];
  const auto chosen =
      select_points(kernels_, level, template_.disparities_at(0), template_.selector());
  const double sigma = layout_.disparity_sigma_px;
  for (PointSelector::Candidate& c : chosen) {
    c.disparity_px += float(random_.uniform(-std::sqrt(3.0) * sigma, std::sqrt(3.0) * sigma));
    c.variance_px2 = float(sigma * sigma);
  }
  TemplateLevel& out = template_.keyframe().levels[0];
  build_template_level(kernels_, chosen, level, rig_.baseline_m, out);
  add_keyframe(T_world_key, out.points, chosen, window_);
}

PlaneWindow::PlaneWindow(const PlaneWorld& world, const Layout& layout)
    : WindowStages(ideal_rig(), layout) {
  for (int k = 0; k < layout.keyframes; ++k) {
    if (k >= kMinWindowKeyframes) (void)refine();
    add(world, T_world_true(k));
  }
}

Se3 PlaneWindow::T_world_true(int keyframe) {
  return Se3::exp(keyframe * motion(0.08, 0.0, 0.12, 0.0, 0.01, 0.0).log());
}

}  // namespace darkling::test
