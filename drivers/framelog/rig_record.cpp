// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/rig_record.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace darkling {

namespace {

constexpr int kMaxSide_px = 16384;  // for arithmetic without overflow, not a promise
constexpr double kNormTolerance = 1e-9;

std::int8_t model_of(Distortion distortion) {
  switch (distortion) {
    case Distortion::kNone:
      return rig_t::MODEL_PINHOLE;
    case Distortion::kRadTan:
      return rig_t::MODEL_RADTAN;
    case Distortion::kEquidistant:
      return rig_t::MODEL_EQUIDISTANT;
  }
  return rig_t::MODEL_UNKNOWN;
}

std::optional<Distortion> distortion_of(std::int8_t model) {
  switch (model) {
    case rig_t::MODEL_PINHOLE:
      return Distortion::kNone;
    case rig_t::MODEL_RADTAN:
      return Distortion::kRadTan;
    case rig_t::MODEL_EQUIDISTANT:
      return Distortion::kEquidistant;
    default:
      return std::nullopt;
  }
}

void write_eye(const Camera& camera, const Se3& T_body_camera, int eye, rig_t& record) {
  record.model[eye] = model_of(camera.distortion);
  record.width[eye] = camera.width;
  record.height[eye] = camera.height;
  const double intrinsics[4] = {camera.fx, camera.fy, camera.cx, camera.cy};
  std::copy_n(intrinsics, 4, record.intrinsics[eye]);
  std::copy_n(camera.coefficients.data(), 4, record.distortion[eye]);
  std::copy_n(T_body_camera.translation().data(), 3, record.translation[eye]);
  const Eigen::Quaterniond& q = T_body_camera.rotation();
  const double rotation[4] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(rotation, 4, record.rotation[eye]);
}

Result<Camera> read_camera(const rig_t& record, int eye) {
  const auto distortion = distortion_of(record.model[eye]);
  if (!distortion) {
    return failure(ExitCode::kBadInput, "camera model " + std::to_string(record.model[eye]) +
                                            " is unknown; known are 1 to 3");
  }
  const std::int32_t width = record.width[eye];
  const std::int32_t height = record.height[eye];
  if (width < 1 || width > kMaxSide_px || height < 1 || height > kMaxSide_px) {
    return failure(ExitCode::kBadInput, "images of " + std::to_string(width) + "x" +
                                            std::to_string(height) + " px; allowed are 1 to " +
                                            std::to_string(kMaxSide_px) + " px a side");
  }
  const double* intrinsics = record.intrinsics[eye];
  Camera camera{.width = width,
                .height = height,
                .fx = intrinsics[0],
                .fy = intrinsics[1],
                .cx = intrinsics[2],
                .cy = intrinsics[3],
                .distortion = *distortion,
                .coefficients = {}};
  std::copy_n(record.distortion[eye], 4, camera.coefficients.data());
  return camera;
}

Result<Se3> read_transform(const rig_t& record, int eye) {
  const double* r = record.rotation[eye];
  const Eigen::Quaterniond q(r[0], r[1], r[2], r[3]);
  const Vector3 t(record.translation[eye][0], record.translation[eye][1],
                  record.translation[eye][2]);
  if (!(std::abs(q.norm() - 1.0) <= kNormTolerance) || !t.allFinite()) {
    return failure(
        ExitCode::kBadInput,
        "the place of a camera on the body is no rigid motion: its quaternion has norm " +
            std::to_string(q.norm()) + ", 1 is needed, and translations are finite");
  }
  return Se3::from_unit(q, t);
}

}  // namespace

rig_t to_rig_record(const StereoRig& rig) {
  rig_t record = {};
  record.layout = rig_t::LAYOUT;
  write_eye(rig.left, rig.T_body_rawleft, 0, record);
  write_eye(rig.right, rig.T_body_rawright, 1, record);
  return record;
}

Result<StereoRig> from_rig_record(const rig_t& record) {
  if (record.layout != rig_t::LAYOUT) {
    return failure(ExitCode::kBadInput, "layout " + std::to_string(record.layout) +
                                            " of frame logs; this version reads layout " +
                                            std::to_string(int{rig_t::LAYOUT}));
  }
  if (record.width[0] != record.width[1] || record.height[0] != record.height[1]) {
    return failure(ExitCode::kBadInput, "the eyes' images differ in size");
  }
  const auto left = read_camera(record, 0);
  if (!left) return tl::unexpected(left.error());
  const auto right = read_camera(record, 1);
  if (!right) return tl::unexpected(right.error());
  const auto T_body_rawleft = read_transform(record, 0);
  if (!T_body_rawleft) return tl::unexpected(T_body_rawleft.error());
  const auto T_body_rawright = read_transform(record, 1);
  if (!T_body_rawright) return tl::unexpected(T_body_rawright.error());
  return StereoRig{*left, *right, *T_body_rawleft, *T_body_rawright};
}

}  // namespace darkling
