// SPDX-License-Identifier: Apache-2.0
// What the importers of YAML files share: YAML values fetched with their place in the file.
// Internal to src/io/calibration_*.cpp; includes yaml-cpp.
#pragma once

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "base/result.h"
#include "geometry/camera.h"
#include "geometry/se3.h"

namespace darkling {

// A YAML map with what messages need to say where it is.
struct YamlSection {
  std::string path;   // of the file
  std::string label;  // "" at the top, else "cam0."
  YAML::Node node;
};

// All of a calibration file.
// @return kConfiguration when it cannot be read, is no file, or is larger than 1 MiB.
[[nodiscard]] Result<std::string> read_calibration_text(const std::string& path);

// @return kConfiguration when `path` cannot be read, is no YAML, or is no map at its top.
[[nodiscard]] Result<YamlSection> read_yaml_file(const std::string& path);

// A node as a person would recognise it, cut short.
[[nodiscard]] std::string describe_node(const YAML::Node& node);

[[nodiscard]] bool has_key(const YamlSection& section, const char* key);

// Of the key's value; of the map's first key where the key is not.
[[nodiscard]] int line_of_key(const YamlSection& section, const char* key);

// "FILE:LINE: key 'cam0.key': found FOUND, allowed is ALLOWED", as kConfiguration.
[[nodiscard]] tl::unexpected<Error> wrong_value(const YamlSection& section, const char* key,
                                                const std::string& found,
                                                const std::string& allowed);

[[nodiscard]] Result<YamlSection> yaml_section(const YamlSection& parent, const char* key);
[[nodiscard]] Result<std::string> yaml_word(const YamlSection& section, const char* key,
                                            const std::string& allowed);
// `count` finite numbers. @param allowed  what they mean, for the message.
[[nodiscard]] Result<std::vector<double>> yaml_numbers(const YamlSection& section, const char* key,
                                                       std::size_t count,
                                                       const std::string& allowed);

// The finite numbers of `list`, which may be a list of lists; `key` is for the message.
[[nodiscard]] Result<std::vector<double>> list_numbers(const YamlSection& section, const char* key,
                                                       const YAML::Node& list,
                                                       const std::string& allowed);

// The rotation nearest to `R`, the value of `key`.
// @return kConfiguration when that is off by more than 1e-3.
[[nodiscard]] Result<Matrix3> nearest_rotation(const YamlSection& section, const char* key,
                                               const Matrix3& R, const std::string& allowed);

// A rigid motion: 16 numbers row by row, as one list, as four lists of four, or under `data`. The
// rotation may be off by 1e-3 (files carry few digits) and is made orthonormal.
[[nodiscard]] Result<Se3> yaml_motion(const YamlSection& section, const char* key);

// The camera of a sensor.yaml or of one cam of a camchain: `camera_model`, `intrinsics`,
// `resolution`, `distortion_model` and its coefficients, which the two formats name differently.
[[nodiscard]] Result<Camera> yaml_camera(const YamlSection& section, const char* coefficients_key);

}  // namespace darkling
