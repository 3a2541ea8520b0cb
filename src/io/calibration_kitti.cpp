// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/text_file.h"
#include "geometry/frames.h"
#include "io/calibration.h"

namespace darkling {

namespace {

// One line "P0: …": the projection of a rectified camera from the reference camera's frame.
struct Projection {
  int line = 0;
  std::array<double, 12> P = {};  // row-major 3×4
};

constexpr const char* kAllowedRow = "12 numbers: f 0 cx t  0 f cy 0  0 0 1 0";

tl::unexpected<Error> wrong_row(const std::string& path, int line, const std::string& key,
                                const std::string& found) {
  return failure(ExitCode::kConfiguration, at_line(path, line) + "key '" + key + "': found " +
                                               found + ", allowed are " + kAllowedRow);
}

// @param text  "P0: 12 numbers".
Result<Projection> parse_row(const std::string& path, const TextLine& line,
                             const std::string& key) {
  Projection projection{.line = line.number};
  const std::string_view numbers = std::string_view(line.text).substr(key.size() + 1);
  const std::vector<std::string_view> words = split(numbers, ' ');
  if (words.size() != projection.P.size()) {
    return wrong_row(path, line.number, key, std::to_string(words.size()) + " numbers");
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto number = parse_number<double>(words[i]);
    if (!number || !std::isfinite(*number)) {
      return wrong_row(path, line.number, key, "'" + std::string(words[i]) + "'");
    }
    projection.P[i] = *number;
  }
  const auto& P = projection.P;
  if (P[0] <= 0.0 || P[5] <= 0.0) {
    return wrong_row(path, line.number, key, "a focal length that is not above 0");
  }
  const bool is_rectified =
      P[1] == 0.0 && P[4] == 0.0 && P[8] == 0.0 && P[9] == 0.0 && P[10] == 1.0;
  if (!is_rectified) {
    return wrong_row(path, line.number, key, "a matrix that no rectified camera has");
  }
  return projection;
}

Result<Projection> find_row(const std::string& path, const std::vector<TextLine>& lines,
                            const std::string& key) {
  bool has_colour = false;
  for (const TextLine& line : lines) {
    if (line.text.starts_with(key + ":")) return parse_row(path, line, key);
    has_colour = has_colour || line.text.starts_with("P2:") || line.text.starts_with("P3:");
  }
  std::string message =
      path + ": key '" + key + "': not found; P0 and P1 of the grey cameras are needed";
  if (has_colour) message += ", P2 and P3 belong to the colour cameras";
  return failure(ExitCode::kConfiguration, message);
}

Camera to_camera(const Projection& projection, int width, int height) {
  const auto& P = projection.P;
  return Camera{.width = width, .height = height, .fx = P[0], .fy = P[5], .cx = P[2], .cy = P[6]};
}

// Where the camera's centre lies in the reference camera's frame, in m: P = K [I | -centre].
Vector3 camera_centre(const Projection& projection) {
  const auto& P = projection.P;
  const double z = P[11];
  return -Vector3((P[3] - P[2] * z) / P[0], (P[7] - P[6] * z) / P[5], z);
}

// A rectified pair has one focal length and one horizon.
Result<void> check_pair(const std::string& path, const Projection& left, const Projection& right) {
  constexpr double kTolerance_px = 0.01;
  const std::array<int, 3> shared = {0, 5, 6};  // fx, fy, cy
  for (const int i : shared) {
    if (std::abs(left.P[i] - right.P[i]) <= kTolerance_px) continue;
    std::ostringstream message;
    message << at_line(path, right.line) << "key 'P1': found " << (i == 6 ? "cy " : "focal length ")
            << right.P[i] << " px where P0 (line " << left.line << ") has " << left.P[i]
            << " px; both must be equal in a rectified pair";
    return failure(ExitCode::kConfiguration, message.str());
  }
  return {};
}

}  // namespace

Result<StereoRig> load_kitti_calibration(const std::string& path, int width, int height) {
  const auto lines = read_text_lines(path);
  if (!lines) return failure(ExitCode::kConfiguration, "calibration " + lines.error().message);
  const auto left = find_row(path, *lines, "P0");
  if (!left) return tl::unexpected(left.error());
  const auto right = find_row(path, *lines, "P1");
  if (!right) return tl::unexpected(right.error());
  if (auto checked = check_pair(path, *left, *right); !checked) {
    return tl::unexpected(checked.error());
  }
  StereoRig rig;
  rig.left = to_camera(*left, width, height);
  rig.right = to_camera(*right, width, height);
  rig.T_body_rawleft = Se3(R_vehicle_optical(), Vector3::Zero());
  const Se3 T_rawleft_rawright(Matrix3::Identity(), camera_centre(*right) - camera_centre(*left));
  rig.T_body_rawright = rig.T_body_rawleft * T_rawleft_rawright;
  if (auto checked = check_rig(rig); !checked) {
    return failure(checked.error().code, at_line(path, right->line) + checked.error().message);
  }
  return rig;
}

}  // namespace darkling
