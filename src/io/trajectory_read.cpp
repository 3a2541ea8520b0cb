// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string_view>

#include "base/text_file.h"
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

struct Layout {
  const char* name;
  PoseFrame frame;
  PoseKey key;
};
constexpr Layout kKitti = {"KITTI", PoseFrame::kLeft, PoseKey::kRow};
constexpr Layout kTum = {"TUM", PoseFrame::kBody, PoseKey::kStamp};
constexpr Layout kEuroc = {"EuRoC", PoseFrame::kBody, PoseKey::kStamp};

Result<const Layout*> recognise(bool has_commas, std::size_t columns) {
  if (has_commas && columns >= kEurocColumns) return &kEuroc;
  if (!has_commas && columns == kKittiColumns) return &kKitti;
  if (!has_commas && columns == kTumColumns) return &kTum;
  return failure(ExitCode::kBadInput,
                 std::to_string(columns) +
                     " columns; a trajectory has 12 (KITTI), 8 (TUM: stamp tx ty tz qx qy qz qw) "
                     "or 8 and more with commas (EuRoC ground truth)");
}

Result<std::vector<double>> parse_numbers(const Cells& cells, std::size_t first) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < cells.size(); ++i) {
    const auto number = parse_number<double>(cells[i]);
    if (!number || !std::isfinite(*number)) {
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
  const auto ns = &layout == &kTum ? ns_from_seconds_text(text) : parse_number<std::int64_t>(text);
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
    const bool has_commas = line.find(',') != std::string_view::npos;
    const Cells cells = split(line, has_commas ? ',' : ' ');
    if (layout_ == nullptr) {
      const auto layout = recognise(has_commas, cells.size());
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
  const auto lines = read_text_lines(path);
  if (!lines) return tl::unexpected(lines.error());
  Reader reader;
  for (const TextLine& line : *lines) {
    const auto read = reader.read_line(line.text);
    if (!read) {
      return failure(read.error().code, at_line(path, line.number) + read.error().message);
    }
  }
  if (reader.trajectory.poses.empty()) {
    return failure(ExitCode::kBadInput, path + ": holds no poses");
  }
  return std::move(reader.trajectory);
}

}  // namespace darkling
