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

  Result<void> add(const StereoFrame& frame, const Se3& T_world_body) override {
    if (!T_first_world_) {
      T_first_world_ = (T_world_body * T_body_left_).inverse();
      first_stamp_ = frame.stamp;
    }
    char name[32];
    std::snprintf(name, sizeof(name), "/%06lld.png", static_cast<long long>(frame.sequence));
    if (auto w = write_png(folder_ + "/image_0" + name, frame.left); !w) return w;
    if (auto w = write_png(folder_ + "/image_1" + name, frame.right); !w) return w;
    poses_.append(format_kitti_row(*T_first_world_ * T_world_body * T_body_left_));
    times_.append(seconds_text_from_ns((frame.stamp - first_stamp_).count()) + "\n");
    return {};
  }

  Result<void> close() override {
    const auto times = times_.close();
    const auto poses = poses_.close();
    return times ? poses : times;
  }

 private:
  std::string folder_;
  Se3 T_body_left_;
  std::optional<Se3> T_first_world_;
  FrameTime first_stamp_;
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
