// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "base/number_text.h"
#include "geometry/common_field.h"
#include "geometry/frames.h"
#include "geometry/stereo_rig.h"

namespace darkling {

namespace {

constexpr int kMinWidth_px = 32;
constexpr int kMinHeight_px = 8;
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMaxAcross_deg = 100.0;  // a plane stretches what is farther out beyond use
constexpr double kMinAcross_deg = 10.0;
// Two pinhole cameras this near to parallel (rad) are taken as rectified: 0.01 px at f = 1000 px,
// what a calibration written with six digits leaves.
constexpr double kParallel_rad = 1e-5;

bool is_pinhole_with_square_pixels(const Camera& camera) {
  return camera.distortion == Distortion::kNone &&
         std::abs(camera.fx - camera.fy) <= 1e-6 * camera.fx;
}

bool is_rectified(const StereoRig& rig, const Se3& T_rawleft_rawright) {
  const Camera& a = rig.left;
  const Camera& b = rig.right;
  const Vector3 direction = T_rawleft_rawright.translation().normalized();
  return is_pinhole_with_square_pixels(a) && is_pinhole_with_square_pixels(b) && a.fx == b.fx &&
         a.cx == b.cx && a.cy == b.cy && rotation_angle(T_rawleft_rawright) < kParallel_rad &&
         std::hypot(direction.y(), direction.z()) < kParallel_rad;
}

// Keeps the source's geometry, scaled.
void keep_intrinsics(const Camera& source, RectifiedRig& rectified) {
  const double k = static_cast<double>(source.width) / rectified.width;
  rectified.focal_px = source.fx / k;
  rectified.cx = reduce_pixel(source.cx, k);
  rectified.cy = reduce_pixel(source.cy, k);
}

// Both cameras take half of the turn between them, then the same least turn that brings the rows
// along the baseline (the split of Bouguet's method as the OpenCV manual describes it).
void turn_axes(const Se3& T_rawleft_rawright, RectifiedRig& rectified) {
  const Eigen::Quaterniond R_rawleft_midway = so3_exp(0.5 * so3_log(T_rawleft_rawright.rotation()));
  const Vector3 b_midway = R_rawleft_midway.conjugate() * T_rawleft_rawright.translation();
  const auto R_midway_rectified = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), b_midway);
  const Eigen::Quaterniond R_rawleft_left = (R_rawleft_midway * R_midway_rectified).normalized();
  rectified.R_rawleft_left = R_rawleft_left.toRotationMatrix();
  rectified.R_rawright_right =
      (T_rawleft_rawright.rotation().conjugate() * R_rawleft_left).toRotationMatrix();
}

Result<void> choose_intrinsics(const StereoRig& rig, RectifiedRig& rectified) {
  const double aspect = static_cast<double>(rectified.width) / rectified.height;
  const auto field = largest_common_field({rig.left, rectified.R_rawleft_left},
                                          {rig.right, rectified.R_rawright_right}, aspect,
                                          std::tan(0.5 * kMaxAcross_deg / kDegrees));
  const double across_deg = field ? 2.0 * std::atan(field->half_width()) * kDegrees : 0.0;
  if (across_deg < kMinAcross_deg) {
    return failure(ExitCode::kConfiguration,
                   "the field of view that both cameras share is " + number_text(across_deg) +
                       "° across; allowed: at least " + number_text(kMinAcross_deg) +
                       "°. Check intrinsics, distortion and the rotation between the cameras");
  }
  // The rectangle reaches from pixel edge to pixel edge, half a pixel beyond the outer centres.
  rectified.focal_px = 0.5 * rectified.width / field->half_width();
  rectified.cx = (field->half_width() - field->centre.x()) * rectified.focal_px - 0.5;
  rectified.cy = (field->half_height - field->centre.y()) * rectified.focal_px - 0.5;
  return {};
}

}  // namespace

int thumbnail_height(const Camera& source, int width_px) {
  return static_cast<int>(
      std::lround(static_cast<double>(width_px) * source.height / source.width));
}

Result<RectifiedRig> rectify_rig(const StereoRig& rig, int width_px) {
  if (const Result<void> checked = check_rig(rig); !checked) return tl::unexpected(checked.error());
  if (width_px != 0 && (width_px < kMinWidth_px || width_px > rig.left.width)) {
    return failure(ExitCode::kConfiguration, "thumbnail width " + std::to_string(width_px) +
                                                 " px; allowed: " + std::to_string(kMinWidth_px) +
                                                 " to " + std::to_string(rig.left.width) +
                                                 " px, or 0 for the width of the source");
  }
  RectifiedRig rectified;
  rectified.width = width_px == 0 ? rig.left.width : width_px;
  rectified.height = thumbnail_height(rig.left, rectified.width);
  if (rectified.height < kMinHeight_px) {
    return failure(ExitCode::kConfiguration,
                   "a thumbnail " + std::to_string(rectified.width) + " px wide is " +
                       std::to_string(rectified.height) + " px high; allowed: at least " +
                       std::to_string(kMinHeight_px) + " px. Ask for a greater width");
  }
  const Se3 T_rawleft_rawright = rig.T_body_rawleft.inverse() * rig.T_body_rawright;
  rectified.baseline_m = T_rawleft_rawright.translation().norm();
  if (is_rectified(rig, T_rawleft_rawright)) {
    keep_intrinsics(rig.left, rectified);
  } else {
    turn_axes(T_rawleft_rawright, rectified);
    const Result<void> chosen = choose_intrinsics(rig, rectified);
    if (!chosen) return tl::unexpected(chosen.error());
  }
  const Se3 T_rawleft_left(rectified.R_rawleft_left, Vector3::Zero());
  rectified.T_body_left = rig.T_body_rawleft * T_rawleft_left;
  return rectified;
}

}  // namespace darkling
