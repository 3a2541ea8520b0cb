// SPDX-License-Identifier: Apache-2.0
#include "io/calibration_yaml.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <Eigen/SVD>

#include "base/number_text.h"
#include "base/text_file.h"

namespace darkling {

namespace {

// No matrix of a calibration has as many elements; aliases of aliases have, in a file of a few
// lines.
constexpr int kMostElements = 64;  // numbers and lists

int line_of(const YAML::Node& node) {
  return node.IsDefined() ? node.Mark().line + 1 : 0;
}

// The scalars of a list of lists, in order.
// @param left  how many elements may still come.
// @return whether that is all of it.
bool collect_scalars(const YAML::Node& node, int& left, std::vector<YAML::Node>& scalars) {
  if (!node.IsSequence()) {
    scalars.push_back(node);
    return true;
  }
  for (const YAML::Node& element : node) {
    if (--left < 0 || !collect_scalars(element, left, scalars)) return false;
  }
  return true;
}

}  // namespace

std::string describe_node(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return "nothing";
  if (node.IsMap()) return "a map";
  if (!node.IsScalar()) return "a list of " + std::to_string(node.size());
  constexpr std::size_t kMostShown = 40;
  std::string text = node.Scalar().substr(0, kMostShown);
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return "'" + text + (node.Scalar().size() > kMostShown ? "..." : "") + "'";
}

Result<std::vector<double>> list_numbers(const YamlSection& section, const char* key,
                                         const YAML::Node& list, const std::string& allowed) {
  if (!list.IsDefined() || !list.IsSequence()) {
    return wrong_value(section, key, describe_node(list), allowed);
  }
  std::vector<YAML::Node> scalars;
  int left = kMostElements;
  if (!collect_scalars(list, left, scalars)) {
    return wrong_value(section, key,
                       "a list of more than " + std::to_string(kMostElements) + " elements",
                       allowed);
  }
  std::vector<double> numbers;
  for (const YAML::Node& scalar : scalars) {
    const auto number =
        scalar.IsScalar() ? parse_number<double>(scalar.Scalar()) : std::optional<double>();
    if (!number || !std::isfinite(*number)) {
      return wrong_value(section, key, describe_node(scalar) + " among the numbers", allowed);
    }
    numbers.push_back(*number);
  }
  return numbers;
}

Result<std::string> read_calibration_text(const std::string& path) {
  const auto refuse = [&path](const std::string& reason) {
    return failure(ExitCode::kConfiguration, path + ": calibration cannot be read: " + reason);
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return refuse(error ? error.message() : std::strerror(ENOENT));
  }
  if (std::filesystem::is_directory(status)) return refuse("it is a folder, a file is needed");
  if (!std::filesystem::is_regular_file(status)) return refuse("it is no file");
  constexpr std::uintmax_t kMostBytes = 1 << 20;
  const std::uintmax_t size_bytes = std::filesystem::file_size(path, error);
  if (!error && size_bytes > kMostBytes) {
    return refuse("it has " + std::to_string(size_bytes) + " bytes, allowed are at most " +
                  std::to_string(kMostBytes));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse(std::strerror(errno));
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (file.bad()) return refuse("an error before its end");
  return text;
}

Result<YamlSection> read_yaml_file(const std::string& path) {
  auto read = read_calibration_text(path);
  if (!read) return tl::unexpected(read.error());
  std::string& text = *read;
  // OpenCV writes a directive that is no YAML ("%YAML:1.0"); a comment in its place keeps the
  // lines.
  if (text.starts_with("%YAML:")) text[0] = '#';
  try {
    YAML::Node node = YAML::Load(text);
    if (!node.IsMap()) {
      return failure(ExitCode::kConfiguration,
                     path + ": found " + describe_node(node) + ", a YAML map of keys is needed");
    }
    return YamlSection{.path = path, .label = "", .node = node};
  } catch (const YAML::Exception& e) {
    return failure(ExitCode::kConfiguration,
                   at_line(path, e.mark.line + 1) + "is not valid YAML: " + e.msg);
  }
}

bool has_key(const YamlSection& section, const char* key) {
  return section.node[key].IsDefined() && !section.node[key].IsNull();
}

int line_of_key(const YamlSection& section, const char* key) {
  const YAML::Node& node = section.node;
  return node[key].IsDefined() ? line_of(node[key]) : line_of(node);
}

tl::unexpected<Error> wrong_value(const YamlSection& section, const char* key,
                                  const std::string& found, const std::string& allowed) {
  return failure(ExitCode::kConfiguration, at_line(section.path, line_of_key(section, key)) +
                                               "key '" + section.label + key + "': found " + found +
                                               ", allowed is " + allowed);
}

Result<YamlSection> yaml_section(const YamlSection& parent, const char* key) {
  const YAML::Node node = parent.node[key];
  if (!node.IsDefined() || !node.IsMap()) {
    return wrong_value(parent, key, describe_node(node), "a map of keys");
  }
  return YamlSection{.path = parent.path, .label = parent.label + key + ".", .node = node};
}

Result<std::string> yaml_word(const YamlSection& section, const char* key,
                              const std::string& allowed) {
  const YAML::Node node = section.node[key];
  if (!node.IsDefined() || !node.IsScalar()) {
    return wrong_value(section, key, describe_node(node), allowed);
  }
  return node.Scalar();
}

Result<std::vector<double>> yaml_numbers(const YamlSection& section, const char* key,
                                         std::size_t count, const std::string& allowed) {
  auto numbers = list_numbers(section, key, section.node[key], allowed);
  if (numbers && numbers->size() != count) {
    return wrong_value(section, key, std::to_string(numbers->size()) + " numbers", allowed);
  }
  return numbers;
}

Result<Se3> yaml_motion(const YamlSection& section, const char* key) {
  const std::string allowed = "16 numbers, row by row: a rotation, a translation in m, 0 0 0 1";
  // Two nodes: assigning to a YAML::Node would change the tree it points into.
  const YAML::Node value = section.node[key];
  const YAML::Node node = value.IsDefined() && value.IsMap() ? value["data"] : value;
  const auto numbers = list_numbers(section, key, node, allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  if (numbers->size() != 16) {
    return wrong_value(section, key, std::to_string(numbers->size()) + " numbers", allowed);
  }
  using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d M = Eigen::Map<const RowMajor4>(numbers->data());
  if ((M.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9) {
    std::ostringstream row;
    row << "the last row " << M.row(3);
    return wrong_value(section, key, row.str(), allowed);
  }
  const Matrix3 R = M.topLeftCorner<3, 3>();
  const auto rotation = nearest_rotation(section, key, R, allowed);
  if (!rotation) return tl::unexpected(rotation.error());
  return Se3(*rotation, Vector3(M.topRightCorner<3, 1>()));
}

Result<Matrix3> nearest_rotation(const YamlSection& section, const char* key, const Matrix3& R,
                                 const std::string& allowed) {
  constexpr double kTolerance = 1e-3;
  const double error = (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  const bool is_rotation = error <= kTolerance && R.determinant() > 0.0;
  if (!is_rotation) {
    const std::string found = "a 3x3 part that is no rotation (rows off orthonormal by " +
                              number_text(error) + ", determinant " + number_text(R.determinant()) +
                              ")";
    return wrong_value(section, key, found, allowed);
  }
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return Matrix3(svd.matrixU() * svd.matrixV().transpose());
}

}  // namespace darkling
