// SPDX-License-Identifier: Apache-2.0
#include "io/calibration_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "base/text_file.h"

namespace darkling {

namespace {

// As OpenCV orders them; the first four are those of Camera.
constexpr std::array kCoefficientNames = {"k1", "k2", "p1", "p2", "k3", "k4",   "k5",
                                          "k6", "s1", "s2", "s3", "s4", "tauX", "tauY"};

std::optional<int> count_in(const YAML::Node& node, const char* key) {
  const YAML::Node count = node[key];
  if (!count.IsDefined() || !count.IsScalar()) return std::nullopt;
  return parse_number<int>(count.Scalar());
}

Result<void> check_shape(const YamlSection& section, const char* key, const YAML::Node& node,
                         const std::string& allowed, YamlMatrix& matrix) {
  const auto rows = count_in(node, "rows");
  const auto cols = count_in(node, "cols");
  if (!rows || !cols) return wrong_value(section, key, "no rows and cols", allowed);
  const auto count = static_cast<long long>(matrix.values.size());
  if (static_cast<long long>(*rows) * *cols != count || *rows < 1) {
    return wrong_value(section, key,
                       std::to_string(count) + " numbers where rows and cols say " +
                           std::to_string(*rows) + "x" + std::to_string(*cols),
                       allowed);
  }
  matrix.rows = *rows;
  matrix.cols = *cols;
  return {};
}

}  // namespace

Result<YamlMatrix> yaml_matrix(const YamlSection& section, const char* key,
                               const std::string& allowed) {
  const YAML::Node node = section.node[key];
  const bool is_map = node.IsDefined() && node.IsMap();
  const YAML::Node list = is_map ? node["data"] : node;
  if (is_map && !list.IsDefined()) return wrong_value(section, key, "a map without data", allowed);
  auto numbers = list_numbers(section, key, list, allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  YamlMatrix matrix{
      .rows = 1, .cols = static_cast<int>(numbers->size()), .values = std::move(*numbers)};
  if (!is_map) return matrix;
  if (auto checked = check_shape(section, key, node, allowed, matrix); !checked) {
    return tl::unexpected(checked.error());
  }
  return matrix;
}

Result<std::vector<double>> yaml_matrix(const YamlSection& section, const char* key, int rows,
                                        int cols, const std::string& allowed) {
  auto matrix = yaml_matrix(section, key, allowed);
  if (!matrix) return tl::unexpected(matrix.error());
  const bool is_list = matrix->rows == 1 && matrix->cols == rows * cols;
  if (!is_list && (matrix->rows != rows || matrix->cols != cols)) {
    return wrong_value(
        section, key,
        std::to_string(matrix->rows) + "x" + std::to_string(matrix->cols) + " numbers", allowed);
  }
  return std::move(matrix->values);
}

Result<void> read_camera_matrix(const YamlSection& section, const char* key, Camera& camera) {
  const std::string allowed = "3x3 numbers: fx 0 cx  0 fy cy  0 0 1, fx and fy above 0 px";
  const auto numbers = yaml_matrix(section, key, 3, 3, allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  const std::vector<double>& K = *numbers;
  if (K[0] <= 0.0 || K[4] <= 0.0) {
    const std::string found = "focal lengths " + number_text(K[0]) + " and " + number_text(K[4]);
    return wrong_value(section, key, found, allowed);
  }
  const bool is_pinhole = K[1] == 0.0 && K[3] == 0.0 && K[6] == 0.0 && K[7] == 0.0 && K[8] == 1.0;
  if (!is_pinhole) return wrong_value(section, key, "a matrix that no pinhole has", allowed);
  camera.fx = K[0];
  camera.fy = K[4];
  camera.cx = K[2];
  camera.cy = K[5];
  return {};
}

Result<void> read_distortion(const YamlSection& section, const char* key, Camera& camera) {
  const bool is_fisheye = camera.distortion == Distortion::kEquidistant;
  const std::string allowed =
      is_fisheye ? "4 numbers: k1, k2, k3, k4" : "4 numbers: k1, k2, p1, p2, and zeros after them";
  const auto matrix = yaml_matrix(section, key, allowed);
  if (!matrix) return tl::unexpected(matrix.error());
  const std::vector<double>& D = matrix->values;
  const std::size_t most = is_fisheye ? camera.coefficients.size() : kCoefficientNames.size();
  const bool is_vector = matrix->rows == 1 || matrix->cols == 1;
  if (!is_vector || D.size() < camera.coefficients.size() || D.size() > most) {
    return wrong_value(
        section, key,
        std::to_string(matrix->rows) + "x" + std::to_string(matrix->cols) + " numbers", allowed);
  }
  for (std::size_t i = camera.coefficients.size(); i < D.size(); ++i) {
    if (D[i] == 0.0) continue;
    return wrong_value(section, key,
                       std::string(kCoefficientNames.at(i)) + " = " + number_text(D[i]),
                       allowed +
                           ". Calibrate again with CALIB_FIX_K3 and without CALIB_RATIONAL_MODEL, "
                           "or a wide lens with the fisheye (equidistant) model");
  }
  std::copy_n(D.begin(), camera.coefficients.size(), camera.coefficients.begin());
  return {};
}

Result<Matrix3> yaml_rotation(const YamlSection& section, const char* key) {
  const std::string allowed = "3x3 numbers, row by row: a rotation";
  const auto numbers = yaml_matrix(section, key, 3, 3, allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return nearest_rotation(section, key, Eigen::Map<const RowMajor3>(numbers->data()), allowed);
}

Result<int> yaml_pixels(const YamlSection& section, const char* key) {
  constexpr int kMaxSize = 16384;
  const std::string allowed = "whole px from 1 to " + std::to_string(kMaxSize);
  const auto word = yaml_word(section, key, allowed);
  if (!word) return tl::unexpected(word.error());
  const auto pixels = parse_number<int>(*word);
  if (!pixels || *pixels < 1 || *pixels > kMaxSize) {
    return wrong_value(section, key, describe_node(section.node[key]), allowed);
  }
  return *pixels;
}

}  // namespace darkling
