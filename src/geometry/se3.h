// SPDX-License-Identifier: Apache-2.0
// Rotations and rigid motions with the calculus the estimator needs. Notation and formulas follow
// Solà, Deray, Atchuthan, "A micro Lie theory for state estimation in robotics" (2018).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace darkling {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// [v]× with [v]× w = v × w.
[[nodiscard]] Matrix3 skew(const Vector3& v);

// Rotation by the vector θ: axis θ/|θ|, angle |θ| in rad.
[[nodiscard]] Eigen::Quaterniond so3_exp(const Vector3& theta);
// The shortest rotation vector of `q`, |θ| <= π.
[[nodiscard]] Vector3 so3_log(const Eigen::Quaterniond& q);
// exp(θ + δ) ≈ exp(θ) exp(J_r(θ) δ).
[[nodiscard]] Matrix3 so3_right_jacobian(const Vector3& theta);
[[nodiscard]] Matrix3 so3_right_jacobian_inverse(const Vector3& theta);

// A rigid motion T_a_b. Named by its frames at every use; see geometry/frames.h.
class Se3 {
 public:
  Se3() = default;
  // @param q  unit quaternion; normalised here.
  // @param t  metres.
  Se3(const Eigen::Quaterniond& q, const Vector3& t) : q_(q.normalized()), t_(t) {}
  // @pre R is orthonormal with determinant +1, to within rounding.
  Se3(const Matrix3& R, const Vector3& t) : Se3(Eigen::Quaterniond(R), t) {}
  // Both as they are, to the bit: normalising a unit quaternion again may move its last digit.
  // @pre |q| = 1 to within rounding, as rotation() gave it.
  [[nodiscard]] static Se3 from_unit(const Eigen::Quaterniond& q, const Vector3& t) {
    Se3 T;
    T.q_ = q;
    T.t_ = t;
    return T;
  }

  [[nodiscard]] const Eigen::Quaterniond& rotation() const { return q_; }
  [[nodiscard]] Matrix3 R() const { return q_.toRotationMatrix(); }
  [[nodiscard]] const Vector3& translation() const { return t_; }
  // The 4×4 homogeneous matrix.
  [[nodiscard]] Eigen::Matrix4d matrix() const;

  [[nodiscard]] Se3 inverse() const;
  [[nodiscard]] Se3 operator*(const Se3& other) const;
  [[nodiscard]] Vector3 operator*(const Vector3& p) const { return q_ * p + t_; }

  // @param xi  (translation, rotation), m and rad.
  [[nodiscard]] static Se3 exp(const Vector6& xi);
  [[nodiscard]] Vector6 log() const;
  // T · exp(ξ) = exp(Ad_T ξ) · T.
  [[nodiscard]] Matrix6 adjoint() const;
  // exp(ξ + δ) ≈ exp(ξ) exp(J_r(ξ) δ).
  [[nodiscard]] static Matrix6 right_jacobian(const Vector6& xi);
  [[nodiscard]] static Matrix6 right_jacobian_inverse(const Vector6& xi);

 private:
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  Vector3 t_ = Vector3::Zero();
};

// T ⊞ ξ and its inverse, T2 ⊟ T1 = log(T1⁻¹ T2): right perturbation.
[[nodiscard]] inline Se3 plus(const Se3& T, const Vector6& xi) {
  return T * Se3::exp(xi);
}
[[nodiscard]] inline Vector6 minus(const Se3& T2, const Se3& T1) {
  return (T1.inverse() * T2).log();
}

// Angle of the rotation in rad, in [0, π].
[[nodiscard]] double rotation_angle(const Se3& T);

}  // namespace darkling
