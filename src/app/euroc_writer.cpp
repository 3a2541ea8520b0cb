// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <sstream>

#include "app/dataset_writer.h"
#include "app/output_file.h"
#include "io/trajectory.h"

namespace darkling {

namespace {

// Every number with the digits that bring the same double back.
std::string describe_sensor(const DatasetDescription& description, const Camera& camera,
                            const Se3& T_body_camera) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << "# " << description.about
      << "\nsensor_type: camera\n\n# T_body_camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [";
  const Eigen::Matrix4d T = T_body_camera.matrix();
  for (int i = 0; i < 16; ++i) out << (i > 0 ? ", " : "") << T(i / 4, i % 4) + 0.0;
  out << "]\n\n";
  if (description.rate_hz > 0.0) out << "rate_hz: " << description.rate_hz << "\n";
  out << "resolution: [" << camera.width << ", " << camera.height
      << "]\ncamera_model: pinhole\nintrinsics: [" << camera.fx << ", " << camera.fy << ", "
      << camera.cx << ", " << camera.cy << "]  # fu, fv, cu, cv\ndistortion_model: "
      << (camera.distortion == Distortion::kEquidistant ? "equidistant" : "radial-tangential")
      << "\ndistortion_coefficients: [";
  for (int i = 0; i < 4; ++i) out << (i > 0 ? ", " : "") << camera.coefficients[i];
  out << "]\n";
  return out.str();
}

class EurocWriter : public DatasetWriter {
 public:
  EurocWriter(const std::string& folder, std::array<OutputFile, 2> indices, OutputFile truth)
      : mav0_(folder + "/mav0"),
        truth_path_(folder + "/groundtruth.tum"),
        indices_(std::move(indices)),
        truth_(std::move(truth)) {}

  Result<void> add(const StereoFrame& frame, const std::optional<Se3>& T_world_body) override {
    const std::string stamp = std::to_string(to_ns(frame.stamp));
    for (int eye = 0; eye < 2; ++eye) {
      const std::string path = mav0_ + "/cam" + std::to_string(eye) + "/data/" + stamp + ".png";
      if (auto w = write_png(path, eye == 0 ? frame.left : frame.right); !w) return w;
    }
    return skip(frame.stamp, T_world_body);
  }

  // The rows name images that are not there.
  Result<void> skip(FrameTime time, const std::optional<Se3>& T_world_body) override {
    const std::string stamp = std::to_string(to_ns(time));
    if (T_world_body) truth_.append(format_tum_row(time, *T_world_body));
    has_truth_ = has_truth_ || T_world_body.has_value();
    for (OutputFile& index : indices_) index.append(stamp + "," + stamp + ".png\n");
    return {};
  }

  Result<void> close() override {
    Result<void> outcome;
    for (OutputFile* file : {&indices_[0], &indices_[1], &truth_}) {
      if (auto closed = file->close(); !closed && outcome) outcome = closed;
    }
    if (!has_truth_ && outcome) outcome = remove_file(truth_path_);
    return outcome;
  }

 private:
  std::string mav0_;
  std::string truth_path_;
  std::array<OutputFile, 2> indices_;
  OutputFile truth_;
  bool has_truth_ = false;
};

// Makes mav0/camN with its calibration. @return the camera's empty index.
Result<OutputFile> create_camera(const DatasetDescription& description, int eye) {
  const std::string folder = description.folder + "/mav0/cam" + std::to_string(eye);
  if (auto made = make_folder(folder + "/data"); !made) return tl::unexpected(made.error());
  auto sensor = OutputFile::open(folder + "/sensor.yaml");
  if (!sensor) return sensor;
  const StereoRig& rig = description.rig;
  sensor->append(eye == 0 ? describe_sensor(description, rig.left, rig.T_body_rawleft)
                          : describe_sensor(description, rig.right, rig.T_body_rawright));
  if (auto closed = sensor->close(); !closed) return tl::unexpected(closed.error());
  auto index = OutputFile::open(folder + "/data.csv");
  if (index) index->append("#timestamp [ns],filename\n");
  return index;
}

}  // namespace

Result<std::unique_ptr<DatasetWriter>> create_euroc_writer(const DatasetDescription& description) {
  auto left = create_camera(description, 0);
  if (!left) return tl::unexpected(left.error());
  auto right = create_camera(description, 1);
  if (!right) return tl::unexpected(right.error());
  auto truth = OutputFile::open(description.folder + "/groundtruth.tum");
  if (!truth) return tl::unexpected(truth.error());
  truth->append("# timestamp(s) tx ty tz qx qy qz qw : T_world_body at mid-exposure\n");
  return std::make_unique<EurocWriter>(
      description.folder, std::array{std::move(*left), std::move(*right)}, std::move(*truth));
}

}  // namespace darkling
