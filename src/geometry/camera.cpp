// SPDX-License-Identifier: Apache-2.0
#include "geometry/camera.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

namespace darkling {

namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

// y = x (1 + c0 x² + c1 x⁴ + c2 x⁶ + c3 x⁸), the radial part of both distortions, on [0, limit):
// over the tangent of the angle from the axis for radtan, over the angle (rad) for equidistant.
struct RadialCurve {
  std::array<double, 4> c = {};
  double limit = std::numeric_limits<double>::infinity();  // the curve rises up to here

  [[nodiscard]] double factor(double x) const {  // y / x
    const double s = x * x;
    return 1.0 + s * (c[0] + s * (c[1] + s * (c[2] + s * c[3])));
  }
  [[nodiscard]] double slope(double x) const {  // dy / dx
    const double s = x * x;
    return 1.0 + s * (3.0 * c[0] + s * (5.0 * c[1] + s * (7.0 * c[2] + s * 9.0 * c[3])));
  }
};

RadialCurve radtan_curve(const Camera& camera) {
  const auto& k = camera.coefficients;
  RadialCurve curve{.c = {k[0], k[1], 0.0, 0.0}};
  // The slope 1 + 3 k1 s + 5 k2 s² with s = x²: its first positive root is where the lens folds.
  const double b = 3.0 * k[0];
  const double discriminant = b * b - 20.0 * k[1];
  const double denominator = discriminant < 0.0 ? 0.0 : std::sqrt(discriminant) - b;
  if (denominator > 0.0) curve.limit = std::sqrt(2.0 / denominator);
  return curve;
}

RadialCurve equidistant_curve(const Camera& camera) {
  RadialCurve curve{.c = camera.coefficients, .limit = std::numbers::pi};
  constexpr int kSteps = 180;
  constexpr double kStep_rad = std::numbers::pi / kSteps;
  for (int i = 1; i <= kSteps; ++i) {
    if (curve.slope(i * kStep_rad) > 0.0) continue;
    double rising = (i - 1) * kStep_rad;
    curve.limit = i * kStep_rad;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = 0.5 * (rising + curve.limit);
      (curve.slope(middle) > 0.0 ? rising : curve.limit) = middle;
    }
    break;
  }
  return curve;
}

// Where the curve reaches y >= 0. Newton's steps, kept inside a bracket that halves when they leave
// it, so that it ends on every rising curve.
std::optional<double> invert(const RadialCurve& curve, double y) {
  double low = 0.0;
  double high = curve.limit;
  if (!std::isfinite(high)) {
    for (high = 1.0; high * curve.factor(high) < y;) high *= 2.0;
  } else if (high * curve.factor(high) <= y) {
    return std::nullopt;
  }
  double x = y < high ? y : 0.5 * high;
  for (int i = 0; i < 100; ++i) {
    const double error = x * curve.factor(x) - y;
    (error > 0.0 ? high : low) = x;
    double next = x - error / curve.slope(x);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-16 * x) return next;
    x = next;
  }
  return x;
}

// Brown's model on the plane z = 1, with the derivative in `J` unless null.
Vector2 distort_radtan(const Camera& camera, const Vector2& n, Matrix2* J) {
  const auto [k1, k2, p1, p2] = camera.coefficients;
  const double x = n.x();
  const double y = n.y();
  const double r2 = n.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * k2);
  if (J != nullptr) {
    const double g = 2.0 * (k1 + 2.0 * k2 * r2);  // d radial / dx = g x
    const double cross = g * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
    *J << radial + g * x * x + 2.0 * p1 * y + 6.0 * p2 * x, cross,  //
        cross, radial + g * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

// Newton's method from the exact inverse of the radial part. Steps are halved until they lessen the
// error and stay inside the fold, so the walk cannot slip to a second solution beyond it.
std::optional<Vector2> undistort_radtan(const Camera& camera, const Vector2& distorted) {
  const RadialCurve curve = radtan_curve(camera);
  const double r = distorted.norm();
  if (r == 0.0) return distorted;
  // Near the fold the tangential part can bring in a little of what the radial part leaves out.
  Vector2 n = distorted * (invert(curve, r).value_or(0.999 * curve.limit) / r);
  const double tolerance = 1e-15 * (1.0 + r);
  Matrix2 J;
  Vector2 error = distort_radtan(camera, n, &J) - distorted;
  for (int i = 0; i < 50 && error.norm() > tolerance; ++i) {
    const Vector2 step = J.inverse() * error;
    bool has_improved = false;
    for (double scale = 1.0; scale > 1e-4 && !has_improved; scale *= 0.5) {
      const Vector2 candidate = n - scale * step;
      Matrix2 candidate_J;
      const Vector2 candidate_error = distort_radtan(camera, candidate, &candidate_J) - distorted;
      has_improved = candidate.norm() < curve.limit && candidate_error.norm() < error.norm();
      if (!has_improved) continue;
      n = candidate;
      J = candidate_J;
      error = candidate_error;
    }
    if (!has_improved) break;
  }
  if (!(error.norm() < 1e-12 * (1.0 + r)) || !(J.determinant() > 0.0)) return std::nullopt;
  return n;
}

// Kannala-Brandt without the focal lengths: x and y of the image in units of the focal length.
Vector2 project_equidistant(const Camera& camera, const Vector3& p, Matrix23* J) {
  const RadialCurve curve{.c = camera.coefficients};
  const double r = std::hypot(p.x(), p.y());
  const double rho2 = r * r + p.z() * p.z();
  const double theta = std::atan2(r, p.z());
  const double scale = r > 0.0 ? theta * curve.factor(theta) / r : 1.0 / p.z();
  if (J != nullptr) {
    const double slope = curve.slope(theta);
    const Vector2 n = r > 0.0 ? Vector2(p.head<2>() / r) : Vector2(1.0, 0.0);
    // d(scale)/dr · r; what cancels near the axis is of the size of rounding in `scale`.
    const double g = slope * p.z() / rho2 - scale;
    J->leftCols<2>() = scale * Matrix2::Identity() + g * n * n.transpose();
    J->col(2) = -slope / rho2 * p.head<2>();
  }
  return scale * p.head<2>();
}

Vector2 project_plane(const Camera& camera, const Vector3& p, Matrix23* J) {
  if (camera.distortion == Distortion::kEquidistant) return project_equidistant(camera, p, J);
  const double inverse_z = 1.0 / p.z();
  const Vector2 n = p.head<2>() * inverse_z;
  if (J != nullptr) {
    *J << inverse_z, 0.0, -n.x() * inverse_z,  //
        0.0, inverse_z, -n.y() * inverse_z;
  }
  if (camera.distortion == Distortion::kNone) return n;
  Matrix2 J_distort;
  const Vector2 distorted = distort_radtan(camera, n, J != nullptr ? &J_distort : nullptr);
  if (J != nullptr) *J = J_distort * *J;
  return distorted;
}

Vector2 to_pixel(const Camera& camera, const Vector2& n) {
  return {camera.fx * n.x() + camera.cx, camera.fy * n.y() + camera.cy};
}

}  // namespace

Eigen::Vector2d project(const Camera& camera, const Vector3& p) {
  return to_pixel(camera, project_plane(camera, p, nullptr));
}

Eigen::Vector2d project(const Camera& camera, const Vector3& p, Eigen::Matrix<double, 2, 3>& J) {
  const Vector2 n = project_plane(camera, p, &J);
  J.row(0) *= camera.fx;
  J.row(1) *= camera.fy;
  return to_pixel(camera, n);
}

std::optional<Vector3> unproject(const Camera& camera, const Eigen::Vector2d& pixel) {
  if (!pixel.allFinite()) return std::nullopt;
  const Vector2 n((pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy);
  if (camera.distortion == Distortion::kNone) return n.homogeneous().normalized();
  if (camera.distortion == Distortion::kRadTan) {
    const std::optional<Vector2> undistorted = undistort_radtan(camera, n);
    if (!undistorted) return std::nullopt;
    return undistorted->homogeneous().normalized();
  }
  const double r = n.norm();
  if (r == 0.0) return Vector3::UnitZ();
  const std::optional<double> theta = invert(equidistant_curve(camera), r);
  if (!theta) return std::nullopt;
  const Vector2 across = n * (std::sin(*theta) / r);
  return Vector3(across.x(), across.y(), std::cos(*theta));
}

}  // namespace darkling
