// SPDX-License-Identifier: Apache-2.0
// What the OpenCV and ROS importers share: matrices as OpenCV's FileStorage lays them out. Internal
// to src/io/calibration_*.cpp; includes yaml-cpp.
#pragma once

#include <string>
#include <vector>

#include "geometry/camera.h"
#include "io/calibration_yaml.h"

namespace darkling {

struct YamlMatrix {
  int rows = 0;
  int cols = 0;
  std::vector<double> values;  // row by row, finite, rows x cols of them
};

// A map of `rows`, `cols` and `data`, or a plain list, which is one row.
// @param allowed  what it should be, for the message.
[[nodiscard]] Result<YamlMatrix> yaml_matrix(const YamlSection& section, const char* key,
                                             const std::string& allowed);
// The same of a given shape; a plain list of as many numbers will do.
[[nodiscard]] Result<std::vector<double>> yaml_matrix(const YamlSection& section, const char* key,
                                                      int rows, int cols,
                                                      const std::string& allowed);

// Focal lengths and principal point of a 3x3 matrix without skew.
[[nodiscard]] Result<void> read_camera_matrix(const YamlSection& section, const char* key,
                                              Camera& camera);

// The four coefficients of `camera.distortion`. Radial-tangential ones may be followed by others of
// OpenCV's model (k3, k4…), which must be 0: ours ends at k2.
[[nodiscard]] Result<void> read_distortion(const YamlSection& section, const char* key,
                                           Camera& camera);

[[nodiscard]] Result<Matrix3> yaml_rotation(const YamlSection& section, const char* key);

// A whole number of pixels from 1 to 16384.
[[nodiscard]] Result<int> yaml_pixels(const YamlSection& section, const char* key);

}  // namespace darkling
