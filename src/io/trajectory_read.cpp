// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "io/decimal_time.h"
#include "io/trajectory.h"

namespace darkling {

namespace {

constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kEurocColumns = 8;  // at least: velocities and biases may follow
// Rotations written with three digits pass, a mixed-up column order does not.
constexpr double kRotationTolerance = 1e-2;

using Cells = std::vector<std::string_view>;

Cells split(std::string_view line) {
  constexpr const char* kSeparators = " \t\r,;";
  Cells cells;
  std::size_t at = line.find_first_not_of(kSeparators);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, at), line.size());
    cells.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSeparators, end);
  }
  return cells;
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

struct Layout {
  const char* name;
  PoseFrame frame;
  PoseKey key;
};
constexpr Layout kKitti = {"KITTI", PoseFrame::kLeft, PoseKey::kRow};
constexpr Layout kTum = {"TUM", PoseFrame::kBody, PoseKey::kStamp};
constexpr Layout kEuroc = {"EuRoC", PoseFrame::kBody, PoseKey::kStamp};

Result<const Layout*> recognise(std::string_view line, std::size_t columns) {
  if (line.find(',') != std::string_view::npos && columns >= kEurocColumns) return &kEuroc;
  if (columns == kKittiColumns) return &kKitti;
  if (columns == kTumColumns) return &kTum;
  return failure(ExitCode::kBadInput,
                 std::to_string(columns) +
                     " columns; a trajectory has 12 (KITTI), 8 (TUM: stamp tx ty tz qx qy qz qw) "
                     "or 8 and more with commas (EuRoC ground truth)");
}

Result<std::vector<double>> parse_numbers(const Cells& cells, std::size_t first) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < cells.size(); ++i) {
    const auto number = parse_number(cells[i]);
    if (!number) {
      return failure(ExitCode::kBadInput, "column " + std::to_string(i + 1) + " is '" +
                                              std::string(cells[i]) + "', not a finite number");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

Result<Eigen::Affine3d> motion_from_matrix(const std::vector<double>& v) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(v.data());
  const Matrix3 R = T.linear();
  const double skewness = (R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (skewness > kRotationTolerance || R.determinant() < 0.0) {
    return failure(ExitCode::kBadInput, "columns 1-3, 5-7, 9-11 are not a rotation matrix");
  }
  return T;
}

Result<Eigen::Affine3d> motion_from_quaternion(const Vector3& t, const Eigen::Quaterniond& q) {
  if (std::abs(q.norm() - 1.0) > kRotationTolerance) {
    return failure(ExitCode::kBadInput,
                   "the quaternion has length " + std::to_string(q.norm()) + ", not 1");
  }
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = t;
  return T;
}

Result<FrameTime> parse_stamp(const Layout& layout, std::string_view text) {
  std::optional<std::int64_t> ns;
  if (&layout == &kTum) {
    ns = ns_from_seconds_text(text);
  } else {
    std::int64_t value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec == std::errc() && parsed.ptr == text.data() + text.size()) ns = value;
  }
  if (ns) return frame_time_from_ns(*ns);
  return failure(ExitCode::kBadInput, "column 1 is '" + std::string(text) + "', not a time in " +
                                          (&layout == &kTum ? "seconds" : "nanoseconds"));
}

Result<TimedPose> parse_row(const Layout& layout, const Cells& cells, std::size_t row) {
  if (&layout == &kKitti) {
    const auto v = parse_numbers(cells, 0);
    if (!v) return tl::unexpected(v.error());
    const auto T = motion_from_matrix(*v);
    if (!T) return tl::unexpected(T.error());
    return TimedPose{frame_time_from_ns(static_cast<std::int64_t>(row)), *T};
  }
  const auto stamp = parse_stamp(layout, cells[0]);
  if (!stamp) return tl::unexpected(stamp.error());
  const auto v = parse_numbers(cells, 1);
  if (!v) return tl::unexpected(v.error());
  const std::vector<double>& c = *v;
  const Eigen::Quaterniond q = &layout == &kTum ? Eigen::Quaterniond(c[6], c[3], c[4], c[5])
                                                : Eigen::Quaterniond(c[3], c[4], c[5], c[6]);
  const auto T = motion_from_quaternion({c[0], c[1], c[2]}, q);
  if (!T) return tl::unexpected(T.error());
  return TimedPose{*stamp, *T};
}

class Reader {
 public:
  Result<void> read_line(std::string_view line) {
    const Cells cells = split(line);
    if (cells.empty() || cells[0].front() == '#') return {};
    if (layout_ == nullptr) {
      const auto layout = recognise(line, cells.size());
      if (!layout) return tl::unexpected(layout.error());
      layout_ = *layout;
      columns_ = cells.size();
      trajectory.frame = layout_->frame;
      trajectory.key = layout_->key;
    }
    if (cells.size() != columns_) {
      return failure(ExitCode::kBadInput,
                     std::to_string(cells.size()) + " columns where the rows before have " +
                         std::to_string(columns_) + " (" + layout_->name + ")");
    }
    const auto pose = parse_row(*layout_, cells, trajectory.poses.size());
    if (!pose) return tl::unexpected(pose.error());
    trajectory.poses.push_back(*pose);
    return {};
  }

  Trajectory trajectory;

 private:
  const Layout* layout_ = nullptr;
  std::size_t columns_ = 0;
};

}  // namespace

Result<Trajectory> read_trajectory(const std::string& path) {
  std::ifstream file(path);
  if (!file) return failure(ExitCode::kNoInput, path + ": " + std::strerror(errno));
  Reader reader;
  std::string line;
  for (int line_number = 1; std::getline(file, line); ++line_number) {
    const auto read = reader.read_line(line);
    if (!read) {
      return failure(read.error().code,
                     path + ":" + std::to_string(line_number) + ": " + read.error().message);
    }
  }
  if (file.bad()) return failure(ExitCode::kNoInput, path + ": " + std::strerror(errno));
  if (reader.trajectory.poses.empty()) {
    return failure(ExitCode::kBadInput, path + ": holds no poses");
  }
  return std::move(reader.trajectory);
}

}  // namespace darkling
