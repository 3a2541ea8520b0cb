// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <optional>
#include <sstream>

#include "app/dataset_writer.h"
#include "app/output_file.h"
#include "io/decimal_time.h"
#include "io/trajectory.h"

namespace darkling {

namespace {

std::string describe_projections(const StereoRig& rig) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(16);
  out << std::scientific;
  const Camera& camera = rig.left;
  const double baseline_m =
      (rig.T_body_rawright.translation() - rig.T_body_rawleft.translation()).norm();
  for (int eye = 0; eye < 2; ++eye) {
    const double shift = eye == 0 ? 0.0 : -camera.fx * baseline_m;
    out << "P" << eye << ": " << camera.fx << " 0 " << camera.cx << " " << shift << " 0 "
        << camera.fy << " " << camera.cy << " 0 0 0 1 0\n";
  }
  return out.str();
}

class KittiWriter : public DatasetWriter {
 public:
  KittiWriter(const DatasetDescription& description, OutputFile times, OutputFile poses)
      : folder_(description.folder),
        T_body_left_(description.rig.T_body_rawleft),
        times_(std::move(times)),
        poses_(std::move(poses)) {}

  Result<void> add(const StereoFrame& frame, const std::optional<Se3>& T_world_body) override {
    char name[32];
    std::snprintf(name, sizeof(name), "/%06lld.png", static_cast<long long>(row_count_));
    if (auto w = write_png(folder_ + "/image_0" + name, frame.left); !w) return w;
    if (auto w = write_png(folder_ + "/image_1" + name, frame.right); !w) return w;
    add_row(frame.stamp, T_world_body);
    return {};
  }

  Result<void> skip(FrameTime stamp, const std::optional<Se3>& T_world_body) override {
    add_row(stamp, T_world_body);
    return {};
  }

  Result<void> close() override {
    const auto times = times_.close();
    auto poses = poses_.close();
    // A line of poses.txt has no stamp: with one missing, the others would be of other frames.
    if (is_pose_missing_ && poses) poses = remove_file(folder_ + "/poses.txt");
    return times ? poses : times;
  }

 private:
  void add_row(FrameTime stamp, const std::optional<Se3>& T_world_body) {
    if (row_count_++ == 0) {
      first_stamp_ = stamp;
      if (T_world_body) T_first_world_ = (*T_world_body * T_body_left_).inverse();
    }
    is_pose_missing_ = is_pose_missing_ || !T_world_body;
    if (!is_pose_missing_) {
      poses_.append(format_kitti_row(*T_first_world_ * *T_world_body * T_body_left_));
    }
    times_.append(seconds_text_from_ns((stamp - first_stamp_).count()) + "\n");
  }

  std::string folder_;
  Se3 T_body_left_;
  std::optional<Se3> T_first_world_;
  FrameTime first_stamp_;
  std::int64_t row_count_ = 0;  // images are named by it
  bool is_pose_missing_ = false;
  OutputFile times_;
  OutputFile poses_;
};

}  // namespace

Result<std::unique_ptr<DatasetWriter>> create_kitti_writer(const DatasetDescription& description) {
  for (const char* name : {"/image_0", "/image_1"}) {
    if (auto made = make_folder(description.folder + name); !made) {
      return tl::unexpected(made.error());
    }
  }
  auto calibration = OutputFile::open(description.folder + "/calib.txt");
  if (!calibration) return tl::unexpected(calibration.error());
  calibration->append(describe_projections(description.rig));
  if (auto closed = calibration->close(); !closed) return tl::unexpected(closed.error());
  auto times = OutputFile::open(description.folder + "/times.txt");
  if (!times) return tl::unexpected(times.error());
  auto poses = OutputFile::open(description.folder + "/poses.txt");
  if (!poses) return tl::unexpected(poses.error());
  return std::make_unique<KittiWriter>(description, std::move(*times), std::move(*poses));
}

}  // namespace darkling
