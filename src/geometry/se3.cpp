// SPDX-License-Identifier: Apache-2.0
#include "geometry/se3.h"

#include <cmath>

namespace darkling {

namespace {

// Below this angle (rad) the closed forms lose digits to cancellation and the series of three
// terms is exact to 1e-16 relative.
constexpr double kSmallAngle = 1e-2;

// The coefficients of I, [θ]× and [θ]×² in the right Jacobian of SO(3) and its relatives:
// b = (1 - cos φ)/φ², c = (φ - sin φ)/φ³, with φ = |θ|.
struct Coefficients {
  double b;
  double c;
};

Coefficients so3_coefficients(double phi) {
  const double phi2 = phi * phi;
  if (phi < kSmallAngle) {
    return {0.5 - phi2 / 24.0 + phi2 * phi2 / 720.0 - phi2 * phi2 * phi2 / 40320.0,
            1.0 / 6.0 - phi2 / 120.0 + phi2 * phi2 / 5040.0};
  }
  const double half_sine = std::sin(0.5 * phi);
  return {2.0 * half_sine * half_sine / phi2, (phi - std::sin(phi)) / (phi2 * phi)};
}

// Solà et al. 2018, eq. (180): the matrix Q of the left Jacobian of SE(3), rho and theta as there.
Matrix3 se3_q(const Vector3& rho, const Vector3& theta) {
  const Matrix3 V = skew(rho);
  const Matrix3 W = skew(theta);
  const double phi = theta.norm();
  const double phi2 = phi * phi;
  const double phi4 = phi2 * phi2;
  const double c = so3_coefficients(phi).c;
  double d;  // (φ² + 2 cos φ - 2) / (2 φ⁴)
  double e;  // (2 φ - 3 sin φ + φ cos φ) / (2 φ⁵)
  if (phi < 0.15) {
    d = 1.0 / 24.0 - phi2 / 720.0 + phi4 / 40320.0 - phi4 * phi2 / 3628800.0;
    e = 1.0 / 120.0 - phi2 / 2520.0 + phi4 / 120960.0 - phi4 * phi2 / 9979200.0;
  } else {
    d = (phi2 + 2.0 * std::cos(phi) - 2.0) / (2.0 * phi4);
    e = (2.0 * phi - 3.0 * std::sin(phi) + phi * std::cos(phi)) / (2.0 * phi4 * phi);
  }
  return 0.5 * V + c * (W * V + V * W + W * V * W) + d * (W * W * V + V * W * W - 3.0 * W * V * W) +
         e * (W * V * W * W + W * W * V * W);
}

Matrix3 so3_left_jacobian(const Vector3& theta) {
  const auto [b, c] = so3_coefficients(theta.norm());
  const Matrix3 W = skew(theta);
  return Matrix3::Identity() + b * W + c * W * W;
}

}  // namespace

Matrix3 skew(const Vector3& v) {
  Matrix3 S;
  S << 0, -v.z(), v.y(),  //
      v.z(), 0, -v.x(),   //
      -v.y(), v.x(), 0;
  return S;
}

Eigen::Quaterniond so3_exp(const Vector3& theta) {
  const double phi = theta.norm();
  const double phi2 = phi * phi;
  const double s = phi < kSmallAngle  // sin(φ/2)/φ
                       ? 0.5 - phi2 / 48.0 + phi2 * phi2 / 3840.0
                       : std::sin(0.5 * phi) / phi;
  const double w = phi < kSmallAngle ? 1.0 - phi2 / 8.0 + phi2 * phi2 / 384.0 : std::cos(0.5 * phi);
  return Eigen::Quaterniond(w, s * theta.x(), s * theta.y(), s * theta.z()).normalized();
}

Vector3 so3_log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // the shorter way round
  const Vector3 v = sign * q.vec();
  const double w = sign * q.w();
  const double n = v.norm();
  if (n < 1e-8) return (2.0 / w) * v;  // atan2(n, w)/n = 1/w - n²/(3 w³) + …
  return (2.0 * std::atan2(n, w) / n) * v;
}

Matrix3 so3_right_jacobian(const Vector3& theta) {
  return so3_left_jacobian(-theta);
}

Matrix3 so3_right_jacobian_inverse(const Vector3& theta) {
  const double phi = theta.norm();
  const double phi2 = phi * phi;
  const Matrix3 W = skew(theta);
  const double k = phi < 0.05  // 1/φ² - (1 + cos φ)/(2 φ sin φ), finite up to φ = π
                       ? 1.0 / 12.0 + phi2 / 720.0 + phi2 * phi2 / 30240.0
                       : 1.0 / phi2 - 0.5 / (phi * std::tan(0.5 * phi));
  return Matrix3::Identity() + 0.5 * W + k * W * W;
}

Eigen::Matrix4d Se3::matrix() const {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = R();
  M.topRightCorner<3, 1>() = t_;
  return M;
}

Se3 Se3::inverse() const {
  const Eigen::Quaterniond q_inverse = q_.conjugate();
  return {q_inverse, -(q_inverse * t_)};
}

Se3 Se3::operator*(const Se3& other) const {
  return {q_ * other.q_, q_ * other.t_ + t_};
}

Se3 Se3::exp(const Vector6& xi) {
  const Vector3 rho = xi.head<3>();
  const Vector3 theta = xi.tail<3>();
  return {so3_exp(theta), so3_left_jacobian(theta) * rho};
}

Vector6 Se3::log() const {
  const Vector3 theta = so3_log(q_);
  Vector6 xi;
  xi.head<3>() = so3_right_jacobian_inverse(-theta) * t_;  // J_l⁻¹(θ) = J_r⁻¹(-θ)
  xi.tail<3>() = theta;
  return xi;
}

Matrix6 Se3::adjoint() const {
  const Matrix3 rotation = R();
  Matrix6 Ad = Matrix6::Zero();
  Ad.topLeftCorner<3, 3>() = rotation;
  Ad.topRightCorner<3, 3>() = skew(t_) * rotation;
  Ad.bottomRightCorner<3, 3>() = rotation;
  return Ad;
}

Matrix6 Se3::right_jacobian(const Vector6& xi) {
  const Vector3 rho = -xi.head<3>();  // J_r(ξ) = J_l(-ξ)
  const Vector3 theta = -xi.tail<3>();
  const Matrix3 J_l = so3_left_jacobian(theta);
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = J_l;
  J.topRightCorner<3, 3>() = se3_q(rho, theta);
  J.bottomRightCorner<3, 3>() = J_l;
  return J;
}

Matrix6 Se3::right_jacobian_inverse(const Vector6& xi) {
  const Vector3 rho = -xi.head<3>();
  const Vector3 theta = -xi.tail<3>();
  const Matrix3 J_l_inverse = so3_right_jacobian_inverse(-theta);
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = J_l_inverse;
  J.topRightCorner<3, 3>() = -J_l_inverse * se3_q(rho, theta) * J_l_inverse;
  J.bottomRightCorner<3, 3>() = J_l_inverse;
  return J;
}

double rotation_angle(const Se3& T) {
  return so3_log(T.rotation()).norm();
}

}  // namespace darkling
