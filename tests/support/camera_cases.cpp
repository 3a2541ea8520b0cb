// SPDX-License-Identifier: Apache-2.0
#include "support/camera_cases.h"

#include <cmath>

#include "support/example_rigs.h"

namespace darkling::test {

namespace {

Camera vga(Distortion distortion, const std::array<double, 4>& coefficients, double focal_px) {
  return {.width = 640,
          .height = 480,
          .fx = focal_px,
          .fy = 1.01 * focal_px,
          .cx = 325.3,
          .cy = 236.8,
          .distortion = distortion,
          .coefficients = coefficients};
}

}  // namespace

std::vector<CameraCase> camera_cases() {
  using enum Distortion;
  // Where the slope of the radial curve vanishes: 1 - 1.2 r², 1 + 0.3 r² - 1.3 r⁴, 1 - 0.3 θ².
  const double radtan_fold_rad = std::atan(std::sqrt(1.0 / 1.2));
  const double late_fold_rad = std::atan(1.0);
  const double equidistant_fold_rad = std::sqrt(1.0 / 0.3);
  return {
      {"Pinhole", kitti_rig().left, 1.5, true},
      {"EurocLeft", euroc_rig().left, 1.5, true},
      {"EurocRight", euroc_rig().right, 1.5, true},
      {"RadTanWithoutCoefficients", vga(kRadTan, {}, 300.0), 1.5, true},
      {"RadTanPincushion", vga(kRadTan, {0.2, 0.05, 0.0, 0.0}, 400.0), 1.5, true},
      {"RadTanTiltedSensor", vga(kRadTan, {-0.1, 0.05, 0.01, -0.02}, 400.0), 1.1, true},
      // Slope 0.007 at r = 1.29: nearly flat there, but it rises again.
      {"RadTanNearlyFolding", vga(kRadTan, {-0.4, 0.0725, 0.0, 0.0}, 300.0), 1.4, true},
      {"RadTanFolding", vga(kRadTan, {-0.4, 0.0, 0.0, 0.0}, 300.0), radtan_fold_rad, false},
      {"RadTanFoldingTilted", vga(kRadTan, {-0.4, 0.0, 0.001, -0.002}, 300.0),
       0.97 * radtan_fold_rad, false},
      {"RadTanFoldingLate", vga(kRadTan, {0.1, -0.26, 0.0, 0.0}, 200.0), late_fold_rad, false},
      {"FisheyeLeft", fisheye_rig().left, 2.0, true},
      {"FisheyeRight", fisheye_rig().right, 2.0, true},
      {"EquidistantWithoutCoefficients", vga(kEquidistant, {}, 180.0), 3.1, true},
      // Newton's method alone ends on the far side of this fold, which lies at 1.15 rad.
      {"EquidistantMisleading", vga(kEquidistant, {-0.198, 0.557, 0.268, -0.336}, 250.0), 1.14,
       false},
      {"EquidistantFolding", vga(kEquidistant, {-0.1, 0.0, 0.0, 0.0}, 180.0), equidistant_fold_rad,
       false},
  };
}

}  // namespace darkling::test
