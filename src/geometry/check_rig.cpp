// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/number_text.h"
#include "geometry/stereo_rig.h"

namespace darkling {

namespace {

constexpr int kMinSide_px = 32;
constexpr int kMaxSide_px = 8192;
constexpr double kMinFocalOverWidth = 0.1;   // wider than any lens: 190° over the width is 0.3
constexpr double kMaxFocalOverWidth = 20.0;  // 3° across
constexpr double kMaxFocalRatio = 2.0;       // fx against fy
constexpr double kMinBaseline_m = 0.005;
constexpr double kMaxBaseline_m = 5.0;
constexpr double kMaxRotation_deg = 30.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;

Result<void> refuse(std::string message) {
  return failure(ExitCode::kConfiguration, std::move(message));
}

std::string size_text(const Camera& camera) {
  return std::to_string(camera.width) + "x" + std::to_string(camera.height);
}

bool is_finite(const Camera& camera) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return finite(camera.fx) && finite(camera.fy) && finite(camera.cx) && finite(camera.cy) &&
         std::all_of(camera.coefficients.begin(), camera.coefficients.end(), finite);
}

Result<void> check_camera(const Camera& camera, const std::string& name) {
  if (std::min(camera.width, camera.height) < kMinSide_px ||
      std::max(camera.width, camera.height) > kMaxSide_px) {
    return refuse(name + " camera: image size " + size_text(camera) +
                  " px; allowed: " + std::to_string(kMinSide_px) + " to " +
                  std::to_string(kMaxSide_px) + " px each side");
  }
  if (!is_finite(camera)) {
    return refuse(name +
                  " camera: a focal length, principal point or distortion coefficient is not a "
                  "finite number; allowed: finite numbers");
  }
  const double low_px = kMinFocalOverWidth * camera.width;
  const double high_px = kMaxFocalOverWidth * camera.width;
  if (std::min(camera.fx, camera.fy) < low_px || std::max(camera.fx, camera.fy) > high_px) {
    return refuse(name + " camera: focal lengths " + number_text(camera.fx) + ", " +
                  number_text(camera.fy) + " px; allowed: " + number_text(low_px) + " to " +
                  number_text(high_px) + " px at this image width");
  }
  const double ratio = camera.fx / camera.fy;
  if (std::max(ratio, 1.0 / ratio) > kMaxFocalRatio) {
    return refuse(name + " camera: focal lengths " + number_text(camera.fx) + " and " +
                  number_text(camera.fy) + " px; allowed: one at most twice the other");
  }
  if (std::abs(camera.cx / camera.width - 0.5) > 1.0 ||
      std::abs(camera.cy / camera.height - 0.5) > 1.0) {
    return refuse(name + " camera: principal point (" + number_text(camera.cx) + ", " +
                  number_text(camera.cy) +
                  ") px; allowed: at most one image size from the centre "
                  "of the " +
                  size_text(camera) + " image");
  }
  return {};
}

Result<void> check_pose(const Se3& T, const std::string& name) {
  // The zero quaternion of a matrix of zeros stays zero when normalised.
  if (T.matrix().allFinite() && std::abs(T.rotation().norm() - 1.0) < 1e-6) return {};
  return refuse(name +
                " camera: its pose on the body is not a rotation and a translation of finite "
                "numbers; allowed: an orthonormal rotation and metres");
}

// Where the right camera sits, in the frame half-way between the orientations of both.
Vector3 baseline_midway(const Se3& T_rawleft_rawright) {
  const Vector3 half = 0.5 * so3_log(T_rawleft_rawright.rotation());
  return so3_exp(half).conjugate() * T_rawleft_rawright.translation();
}

// Translations come in the unit in which the squares of the calibration board were given.
std::string unit_remedy(double length_m) {
  constexpr double kMillimetres = 1e-3;
  const double as_mm = length_m * kMillimetres;
  if (as_mm < kMinBaseline_m) return "";
  std::string remedy = ". Is the translation in metres?";
  if (as_mm <= kMaxBaseline_m) {
    remedy += " Were it in mm, the baseline would be " + number_text(as_mm) +
              " m: divide it by 1000; were it in squares of the board, multiply it by their "
              "side in m";
  }
  return remedy;
}

Result<void> check_baseline(const Vector3& b) {
  const std::string found = "the right camera is at (" + number_text(b.x()) + ", " +
                            number_text(b.y()) + ", " + number_text(b.z()) +
                            ") m from the left one (x right, y down, z forward)";
  const double length_m = b.norm();
  // Said so that it refuses what overflowed to no number, too.
  const bool is_plausible = length_m >= kMinBaseline_m && length_m <= kMaxBaseline_m;
  if (!is_plausible) {
    return refuse("baseline of " + number_text(length_m) + " m: " + found +
                  "; allowed: " + number_text(kMinBaseline_m) + " to " +
                  number_text(kMaxBaseline_m) + " m" + unit_remedy(length_m));
  }
  if (std::abs(b.y()) > std::abs(b.x()) && std::abs(b.y()) > std::abs(b.z())) {
    return refuse("the cameras are mounted one above the other: " + found +
                  "; allowed: side by side. Turn the images of both by 90° to use such a rig");
  }
  if (std::abs(b.z()) > std::abs(b.x())) {
    return refuse("the cameras are mounted one behind the other: " + found +
                  "; allowed: side by side");
  }
  if (b.x() < 0.0) {
    return refuse("the eyes look swapped, with a baseline of " + number_text(b.x()) +
                  " m: " + found +
                  "; allowed: x above zero. Exchange left and right, or the direction of "
                  "the transform between them");
  }
  const double slant_deg = std::atan2(std::hypot(b.y(), b.z()), b.x()) * kDegrees;
  if (slant_deg > kMaxRotation_deg) {
    return refuse("the baseline is " + number_text(slant_deg) + "° off the image rows: " + found +
                  "; allowed: at most " + number_text(kMaxRotation_deg) + "°");
  }
  return {};
}

}  // namespace

Result<void> check_rig(const StereoRig& rig) {
  return check_camera(rig.left, "left")
      .and_then([&] { return check_camera(rig.right, "right"); })
      .and_then([&] { return check_pose(rig.T_body_rawleft, "left"); })
      .and_then([&] { return check_pose(rig.T_body_rawright, "right"); })
      .and_then([&]() -> Result<void> {
        if (rig.left.width != rig.right.width || rig.left.height != rig.right.height) {
          return refuse("the left images are " + size_text(rig.left) + " px, the right ones " +
                        size_text(rig.right) + " px; allowed: the same size");
        }
        const Se3 T_rawleft_rawright = rig.T_body_rawleft.inverse() * rig.T_body_rawright;
        const double turn_deg = rotation_angle(T_rawleft_rawright) * kDegrees;
        if (turn_deg > kMaxRotation_deg) {
          return refuse("the cameras are turned " + number_text(turn_deg) +
                        "° against each other; allowed: at most " + number_text(kMaxRotation_deg) +
                        "°. Are both poses given in the same direction (camera to body)?");
        }
        return check_baseline(baseline_midway(T_rawleft_rawright));
      });
}

}  // namespace darkling
