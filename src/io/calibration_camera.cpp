// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/nearest.h"
#include "base/number_text.h"
#include "io/calibration_yaml.h"

namespace darkling {

namespace {

struct DistortionName {
  std::string_view name;
  Distortion distortion;
};

// EuRoC spells the models out, Kalibr shortens them; either is taken from both.
constexpr std::array kDistortionNames = {
    DistortionName{"radial-tangential", Distortion::kRadTan},
    DistortionName{"radtan", Distortion::kRadTan},
    DistortionName{"equidistant", Distortion::kEquidistant},
    DistortionName{"equi", Distortion::kEquidistant},
    DistortionName{"none", Distortion::kNone},
};

constexpr const char* kAllowedDistortion = "radial-tangential (radtan), equidistant (equi) or none";

Result<Distortion> read_distortion(const YamlSection& section) {
  const auto word = yaml_word(section, "distortion_model", kAllowedDistortion);
  if (!word) return tl::unexpected(word.error());
  std::array<std::string_view, kDistortionNames.size()> names;
  std::transform(kDistortionNames.begin(), kDistortionNames.end(), names.begin(),
                 [](const DistortionName& known) { return known.name; });
  const auto found = std::find(names.begin(), names.end(), *word);
  if (found != names.end()) return kDistortionNames.at(found - names.begin()).distortion;
  std::string allowed = kAllowedDistortion;
  if (const auto nearest = nearest_name(*word, names)) {
    allowed += "; did you mean '" + std::string(*nearest) + "'?";
  }
  return wrong_value(section, "distortion_model", "'" + *word + "'", allowed);
}

Result<void> read_size(const YamlSection& section, Camera& camera) {
  constexpr double kMaxSize = 16384;  // px; what a 4-byte pixel count still addresses easily
  const std::string allowed = "[width, height], whole px from 1 to 16384";
  const auto size = yaml_numbers(section, "resolution", 2, allowed);
  if (!size) return tl::unexpected(size.error());
  for (const double pixels : *size) {
    if (pixels < 1 || pixels > kMaxSize || pixels != std::floor(pixels)) {
      return wrong_value(section, "resolution", number_text(pixels), allowed);
    }
  }
  camera.width = static_cast<int>((*size)[0]);
  camera.height = static_cast<int>((*size)[1]);
  return {};
}

Result<void> read_intrinsics(const YamlSection& section, Camera& camera) {
  const std::string allowed = "[fx, fy, cx, cy] in px, fx and fy above 0";
  const auto intrinsics = yaml_numbers(section, "intrinsics", 4, allowed);
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  const std::vector<double>& k = *intrinsics;
  if (k[0] <= 0.0 || k[1] <= 0.0) {
    const std::string found = "focal lengths " + number_text(k[0]) + " and " + number_text(k[1]);
    return wrong_value(section, "intrinsics", found, allowed);
  }
  camera.fx = k[0];
  camera.fy = k[1];
  camera.cx = k[2];
  camera.cy = k[3];
  return {};
}

Result<void> read_coefficients(const YamlSection& section, const char* key, Camera& camera) {
  // A pinhole may come without coefficients, or with zeros that mean the same.
  const bool is_none = camera.distortion == Distortion::kNone;
  if (is_none && (!has_key(section, key) || section.node[key].size() == 0)) return {};
  const std::string allowed = is_none ? "no coefficients, or four zeros"
                              : camera.distortion == Distortion::kRadTan
                                  ? "4 finite numbers: k1, k2, p1, p2"
                                  : "4 finite numbers: k1, k2, k3, k4";
  const auto numbers = yaml_numbers(section, key, camera.coefficients.size(), allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  std::copy(numbers->begin(), numbers->end(), camera.coefficients.begin());
  const bool are_zero = std::all_of(numbers->begin(), numbers->end(),
                                    [](double coefficient) { return coefficient == 0.0; });
  if (is_none && !are_zero) {
    return wrong_value(section, key, "coefficients that are not zero", allowed);
  }
  return {};
}

}  // namespace

Result<Camera> yaml_camera(const YamlSection& section, const char* coefficients_key) {
  const auto model = yaml_word(section, "camera_model", "pinhole");
  if (!model) return tl::unexpected(model.error());
  if (*model != "pinhole") {
    return wrong_value(section, "camera_model", "'" + *model + "'",
                       "pinhole (calibrate wide lenses as pinhole with equidistant distortion)");
  }
  Camera camera;
  if (auto read = read_size(section, camera); !read) return tl::unexpected(read.error());
  if (auto read = read_intrinsics(section, camera); !read) return tl::unexpected(read.error());
  const auto distortion = read_distortion(section);
  if (!distortion) return tl::unexpected(distortion.error());
  camera.distortion = *distortion;
  if (auto read = read_coefficients(section, coefficients_key, camera); !read) {
    return tl::unexpected(read.error());
  }
  return camera;
}

}  // namespace darkling
