// SPDX-License-Identifier: Apache-2.0
// Stereo calibrations in OpenCV's FileStorage. R and T are those of cv::stereoCalibrate(): they
// take a point from the first (left) camera's frame to the second's, p_right = R p_left + T, so
// they are T_right_left, and T.x is below 0 for a right camera on the right. T has the unit in
// which the board's squares were given, which the file does not say: it must be m.
#include <array>
#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "base/text_file.h"
#include "geometry/frames.h"
#include "io/calibration.h"
#include "io/calibration_matrix.h"

namespace darkling {

namespace {

// The names in use for one thing, the one for messages first.
using KeyNames = std::array<const char*, 3>;

struct EyeNames {
  KeyNames matrix;
  KeyNames distortion;
};

constexpr EyeNames kLeftNames = {.matrix = {"M1", "K1", "cameraMatrix1"},
                                 .distortion = {"D1", "distCoeffs1", "dist_coeffs1"}};
constexpr EyeNames kRightNames = {.matrix = {"M2", "K2", "cameraMatrix2"},
                                  .distortion = {"D2", "distCoeffs2", "dist_coeffs2"}};

const char* find_name(const YamlSection& section, const KeyNames& names) {
  for (const char* name : names) {
    if (has_key(section, name)) return name;
  }
  return names.front();
}

// @pre the section has the key.
Result<std::optional<ImageSize>> read_size_list(const YamlSection& section, const char* key) {
  const std::string allowed = "[width, height], whole px from 1 to 16384";
  const auto sides = yaml_numbers(section, key, 2, allowed);
  if (!sides) return tl::unexpected(sides.error());
  for (const double side : *sides) {
    if (side >= 1.0 && side <= 16384.0 && side == std::floor(side)) continue;
    return wrong_value(section, key, number_text(side), allowed);
  }
  return ImageSize{.width = static_cast<int>((*sides)[0]), .height = static_cast<int>((*sides)[1])};
}

// Nothing where the section does not say.
Result<std::optional<ImageSize>> read_size(const YamlSection& section) {
  constexpr KeyNames kWidthNames = {"image_width", "imageWidth", "width"};
  constexpr KeyNames kHeightNames = {"image_height", "imageHeight", "height"};
  const char* width_name = find_name(section, kWidthNames);
  const char* height_name = find_name(section, kHeightNames);
  if (has_key(section, width_name) || has_key(section, height_name)) {
    const auto width = yaml_pixels(section, width_name);
    if (!width) return tl::unexpected(width.error());
    const auto height = yaml_pixels(section, height_name);
    if (!height) return tl::unexpected(height.error());
    return ImageSize{.width = *width, .height = *height};
  }
  const char* list_name = find_name(section, {"imageSize", "image_size", "size"});
  if (has_key(section, list_name)) return read_size_list(section, list_name);
  return std::nullopt;
}

// OpenCV's own tools write fisheye_model; nothing means the usual model.
Result<Distortion> read_model(const YamlSection& section) {
  if (has_key(section, "fisheye_model")) {
    const auto word = yaml_word(section, "fisheye_model", "0 or 1");
    if (!word) return tl::unexpected(word.error());
    if (*word != "0" && *word != "1") {
      return wrong_value(section, "fisheye_model", describe_node(section.node["fisheye_model"]),
                         "0 or 1");
    }
    return *word == "1" ? Distortion::kEquidistant : Distortion::kRadTan;
  }
  if (!has_key(section, "distortion_model")) return Distortion::kRadTan;
  const std::string allowed =
      "plumb_bob (radtan), fisheye (equidistant), or no such key: plumb_bob";
  const auto word = yaml_word(section, "distortion_model", allowed);
  if (!word) return tl::unexpected(word.error());
  if (*word == "plumb_bob" || *word == "radtan") return Distortion::kRadTan;
  if (*word == "fisheye" || *word == "equidistant") return Distortion::kEquidistant;
  return wrong_value(section, "distortion_model", describe_node(section.node["distortion_model"]),
                     allowed);
}

Result<Camera> read_camera(const YamlSection& section, const EyeNames& names, ImageSize size) {
  Camera camera{.width = size.width, .height = size.height};
  const auto model = read_model(section);
  if (!model) return tl::unexpected(model.error());
  camera.distortion = *model;
  const auto read =
      read_camera_matrix(section, find_name(section, names.matrix), camera).and_then([&] {
        return read_distortion(section, find_name(section, names.distortion), camera);
      });
  if (!read) return tl::unexpected(read.error());
  return camera;
}

Result<Se3> read_motion(const YamlSection& section) {
  const auto R = yaml_rotation(section, "R");
  if (!R) return tl::unexpected(R.error());
  const auto T = yaml_matrix(section, "T", 3, 1, "3x1 numbers, in m");
  if (!T) return tl::unexpected(T.error());
  return Se3(*R, Vector3((*T)[0], (*T)[1], (*T)[2]));
}

Result<ImageSize> choose_size(const YamlSection& intrinsics, const YamlSection& extrinsics,
                              std::optional<ImageSize> size) {
  for (const YamlSection* section : {&intrinsics, &extrinsics}) {
    const auto found = read_size(*section);
    if (!found) return tl::unexpected(found.error());
    if (*found) return **found;
  }
  if (size) return *size;
  return wrong_value(intrinsics, "image_width", "nothing, and no images say their size",
                     "image_width and image_height, or imageSize: [width, height]; add them");
}

}  // namespace

Result<StereoRig> load_opencv_calibration(const std::string& intrinsics_path,
                                          const std::string& extrinsics_path,
                                          std::optional<ImageSize> size) {
  const auto intrinsics = read_yaml_file(intrinsics_path);
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  const auto extrinsics = read_yaml_file(extrinsics_path);
  if (!extrinsics) return tl::unexpected(extrinsics.error());
  const auto chosen = choose_size(*intrinsics, *extrinsics, size);
  if (!chosen) return tl::unexpected(chosen.error());
  const auto left = read_camera(*intrinsics, kLeftNames, *chosen);
  if (!left) return tl::unexpected(left.error());
  const auto right = read_camera(*intrinsics, kRightNames, *chosen);
  if (!right) return tl::unexpected(right.error());
  const auto T_right_left = read_motion(*extrinsics);
  if (!T_right_left) return tl::unexpected(T_right_left.error());
  StereoRig rig;
  rig.left = *left;
  rig.right = *right;
  rig.T_body_rawleft = Se3(R_vehicle_optical(), Vector3::Zero());
  rig.T_body_rawright = rig.T_body_rawleft * T_right_left->inverse();
  if (auto checked = check_rig(rig); !checked) {
    return failure(checked.error().code, at_line(extrinsics_path, line_of_key(*extrinsics, "T")) +
                                             "keys 'R' and 'T': " + checked.error().message);
  }
  return rig;
}

}  // namespace darkling
