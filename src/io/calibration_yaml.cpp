// SPDX-License-Identifier: Apache-2.0
#include "io/calibration_yaml.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include <Eigen/SVD>

#include "base/number_text.h"
#include "base/text_file.h"

namespace darkling {

namespace {

// A node as a person would recognise it, cut short.
std::string describe(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return "nothing";
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsMap()) return "a map";
  return "a list of " + std::to_string(node.size());
}

int line_of(const YAML::Node& node) {
  return node.IsDefined() ? node.Mark().line + 1 : 0;
}

// The scalars of a list of any depth, in order.
void collect_scalars(const YAML::Node& node, std::vector<YAML::Node>& scalars) {
  if (!node.IsSequence()) {
    scalars.push_back(node);
    return;
  }
  for (const YAML::Node& element : node) collect_scalars(element, scalars);
}

Result<std::vector<double>> to_numbers(const YamlSection& section, const char* key,
                                       const YAML::Node& list, const std::string& allowed) {
  std::vector<YAML::Node> scalars;
  if (list.IsDefined() && !list.IsNull()) collect_scalars(list, scalars);
  std::vector<double> numbers;
  for (const YAML::Node& scalar : scalars) {
    const auto number =
        scalar.IsScalar() ? parse_number<double>(scalar.Scalar()) : std::optional<double>();
    if (!number || !std::isfinite(*number)) {
      return wrong_value(section, key, describe(scalar) + " among the numbers", allowed);
    }
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

Result<YamlSection> read_yaml_file(const std::string& path) {
  std::ifstream file(path);
  std::stringstream content;
  if (file) content << file.rdbuf();
  if (!file || content.fail()) {
    return failure(ExitCode::kConfiguration,
                   path + ": calibration cannot be read: " + std::strerror(errno));
  }
  std::string text = content.str();
  // OpenCV writes a directive that is no YAML ("%YAML:1.0"); a comment in its place keeps the
  // lines.
  if (text.starts_with("%YAML:")) text[0] = '#';
  try {
    YAML::Node node = YAML::Load(text);
    if (!node.IsMap()) {
      return failure(ExitCode::kConfiguration,
                     path + ": found " + describe(node) + ", a YAML map of keys is needed");
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

tl::unexpected<Error> wrong_value(const YamlSection& section, const char* key,
                                  const std::string& found, const std::string& allowed) {
  const YAML::Node& node = section.node;
  const int line = node[key].IsDefined() ? line_of(node[key]) : line_of(node);
  return failure(ExitCode::kConfiguration, at_line(section.path, line) + "key '" + section.label +
                                               key + "': found " + found + ", allowed is " +
                                               allowed);
}

Result<YamlSection> yaml_section(const YamlSection& parent, const char* key) {
  const YAML::Node node = parent.node[key];
  if (!node.IsDefined() || !node.IsMap()) {
    return wrong_value(parent, key, describe(node), "a map of keys");
  }
  return YamlSection{.path = parent.path, .label = parent.label + key + ".", .node = node};
}

Result<std::string> yaml_word(const YamlSection& section, const char* key,
                              const std::string& allowed) {
  const YAML::Node node = section.node[key];
  if (!node.IsDefined() || !node.IsScalar()) {
    return wrong_value(section, key, describe(node), allowed);
  }
  return node.Scalar();
}

Result<std::vector<double>> yaml_numbers(const YamlSection& section, const char* key,
                                         std::size_t count, const std::string& allowed) {
  const YAML::Node node = section.node[key];
  if (!node.IsDefined() || !node.IsSequence()) {
    return wrong_value(section, key, describe(node), allowed);
  }
  auto numbers = to_numbers(section, key, node, allowed);
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
  if (!node.IsDefined() || !node.IsSequence()) {
    return wrong_value(section, key, describe(node), allowed);
  }
  const auto numbers = to_numbers(section, key, node, allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  if (numbers->size() != 16) {
    return wrong_value(section, key, std::to_string(numbers->size()) + " numbers", allowed);
  }
  using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d M = Eigen::Map<const RowMajor4>(numbers->data());
  constexpr double kTolerance = 1e-3;
  if ((M.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9) {
    std::ostringstream row;
    row << "the last row " << M.row(3);
    return wrong_value(section, key, row.str(), allowed);
  }
  const Matrix3 R = M.topLeftCorner<3, 3>();
  const double error = (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (error > kTolerance || R.determinant() < 0.0) {
    const std::string found = "a 3x3 part that is no rotation (rows off orthonormal by " +
                              number_text(error) + ", determinant " + number_text(R.determinant()) +
                              ")";
    return wrong_value(section, key, found, allowed);
  }
  // The rotation nearest to R.
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return Se3(Matrix3(svd.matrixU() * svd.matrixV().transpose()), Vector3(M.topRightCorner<3, 1>()));
}

}  // namespace darkling
