// SPDX-License-Identifier: Apache-2.0
// ROS camera_info, after the comments of sensor_msgs/CameraInfo.msg: K and D are the raw camera's.
// R turns a ray of the raw camera into one of the ideal, rectified camera: p_rect = R p_raw. P
// projects a point given in the rectified *left* camera's frame into the rectified image of either;
// hence the right one's P[3] = -fx * baseline.
#include "base/text_file.h"
#include "geometry/frames.h"
#include "io/calibration.h"
#include "io/calibration_matrix.h"

namespace darkling {

namespace {

struct CameraInfo {
  YamlSection section;  // for messages
  Camera camera;
  Matrix3 R_rect_raw;
  Vector3 centre;  // m, of the camera in the rectified left frame
};

Result<Distortion> read_model(const YamlSection& section) {
  const std::string allowed = "plumb_bob, equidistant or fisheye";
  const auto word = yaml_word(section, "distortion_model", allowed);
  if (!word) return tl::unexpected(word.error());
  if (*word == "plumb_bob") return Distortion::kRadTan;
  if (*word == "equidistant" || *word == "fisheye") return Distortion::kEquidistant;
  const std::string found = describe_node(section.node["distortion_model"]);
  if (*word != "rational_polynomial") {
    return wrong_value(section, "distortion_model", found, allowed);
  }
  return wrong_value(section, "distortion_model", found,
                     allowed +
                         ". The rational model has coefficients that Darkling's lenses do not: "
                         "calibrate again with plumb_bob (two radial coefficients), or a wide lens "
                         "with the fisheye (equidistant) model");
}

// Where the camera's centre lies: P = K [I | -centre].
Result<Vector3> read_centre(const YamlSection& section) {
  constexpr const char* kKey = "projection_matrix";
  const std::string allowed =
      "3x4 numbers: fx 0 cx -fx*b  0 fy cy 0  0 0 1 0, of a rectified camera";
  const auto numbers = yaml_matrix(section, kKey, 3, 4, allowed);
  if (!numbers) return tl::unexpected(numbers.error());
  const std::vector<double>& P = *numbers;
  const bool is_rectified = P[0] > 0.0 && P[5] > 0.0 && P[1] == 0.0 && P[4] == 0.0 && P[8] == 0.0 &&
                            P[9] == 0.0 && P[10] == 1.0 && P[11] == 0.0;
  if (!is_rectified) {
    return wrong_value(section, kKey, "a matrix that no rectified camera has", allowed);
  }
  return Vector3(-P[3] / P[0], -P[7] / P[5], 0.0);
}

Result<CameraInfo> read_camera_info(const std::string& path) {
  auto section = read_yaml_file(path);
  if (!section) return tl::unexpected(section.error());
  CameraInfo info{.section = std::move(*section), .camera = {}, .R_rect_raw = {}, .centre = {}};
  const auto width = yaml_pixels(info.section, "image_width");
  if (!width) return tl::unexpected(width.error());
  const auto height = yaml_pixels(info.section, "image_height");
  if (!height) return tl::unexpected(height.error());
  info.camera.width = *width;
  info.camera.height = *height;
  const auto model = read_model(info.section);
  if (!model) return tl::unexpected(model.error());
  info.camera.distortion = *model;
  const auto read = read_camera_matrix(info.section, "camera_matrix", info.camera).and_then([&] {
    return read_distortion(info.section, "distortion_coefficients", info.camera);
  });
  if (!read) return tl::unexpected(read.error());
  const auto rotation = yaml_rotation(info.section, "rectification_matrix");
  if (!rotation) return tl::unexpected(rotation.error());
  info.R_rect_raw = *rotation;
  const auto centre = read_centre(info.section);
  if (!centre) return tl::unexpected(centre.error());
  info.centre = *centre;
  return info;
}

}  // namespace

Result<StereoRig> load_ros_calibration(const std::string& left_path,
                                       const std::string& right_path) {
  const auto left = read_camera_info(left_path);
  if (!left) return tl::unexpected(left.error());
  const auto right = read_camera_info(right_path);
  if (!right) return tl::unexpected(right.error());
  const Vector3 baseline = right->centre - left->centre;  // of the rectified right in the left
  if (baseline.isZero()) {
    return wrong_value(right->section, "projection_matrix", "no baseline: its fourth column is 0",
                       "P[3] = -fx * baseline in m. A camera calibrated by itself does not know "
                       "the other: calibrate both as a stereo pair");
  }
  StereoRig rig;
  rig.left = left->camera;
  rig.right = right->camera;
  rig.T_body_rawleft = Se3(R_vehicle_optical(), Vector3::Zero());
  // raw left ← rectified left ← rectified right ← raw right
  const Se3 T_rawleft_rectleft(Matrix3(left->R_rect_raw.transpose()), Vector3::Zero());
  const Se3 T_rectleft_rectright(Matrix3(Matrix3::Identity()), baseline);
  const Se3 T_rectright_rawright(right->R_rect_raw, Vector3::Zero());
  rig.T_body_rawright =
      rig.T_body_rawleft * T_rawleft_rectleft * T_rectleft_rectright * T_rectright_rawright;
  if (auto checked = check_rig(rig); !checked) {
    return failure(checked.error().code,
                   at_line(right_path, line_of_key(right->section, "projection_matrix")) + "with " +
                       left_path + ": " + checked.error().message);
  }
  return rig;
}

}  // namespace darkling
