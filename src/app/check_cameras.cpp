// SPDX-License-Identifier: Apache-2.0
#include "app/check_cameras.h"

#include "app/open_source.h"
#include "base/number_text.h"
#include "drivers/camera/eye_layout.h"
#include "drivers/framelog/framelog_source.h"
#include "drivers/v4l2/negotiate_format.h"
#include "drivers/v4l2/v4l2_source.h"
#include "drivers/v4l2/v4l2_spec.h"
#include "io/calibration.h"

namespace darkling {

namespace {

constexpr const char* kCalibration = "calibration";
constexpr const char* kCamera = "camera";
constexpr std::string_view kV4l2 = "v4l2:";
constexpr std::string_view kLibcamera = "libcamera:";
constexpr std::string_view kSynthetic = "synthetic:";
constexpr std::string_view kFrameLog = ".lcmlog";

// Of one eye, where the configuration says it.
std::optional<ImageSize> configured_size(const CameraConfig& camera) {
  if (camera.width_px == 0 || camera.height_px == 0) return std::nullopt;
  const ImageExtent eye =
      eye_extent(camera.layout, grey_extent(camera.format, {camera.width_px, camera.height_px}));
  if (eye == ImageExtent{}) return std::nullopt;
  return ImageSize{.width = eye.width, .height = eye.height};
}

std::string rig_text(const StereoRig& rig) {
  const double baseline_m =
      (rig.T_body_rawleft.inverse() * rig.T_body_rawright).translation().norm();
  return "baseline " + number_text(baseline_m) + " m, images " + std::to_string(rig.left.width) +
         " x " + std::to_string(rig.left.height) + " px, focal length " + number_text(rig.left.fx) +
         " px";
}

// A recording, a scene or a frame log: has images and a rig of its own.
struct Played {
  std::string calibration;  // where the rig is from
  StereoRig rig;
  std::unique_ptr<FrameSource> source;
};

Result<Played> open_played(const std::string& text) {
  if (text.ends_with(kFrameLog)) {
    auto log = open_frame_log(text);
    if (!log) return tl::unexpected(log.error());
    const StereoRig rig = log->rig;
    return Played{
        .calibration = text,
        .rig = rig,
        .source = std::make_unique<FramelogSource>(std::move(log->events), std::move(log->rows))};
  }
  auto opened = open_source(text, {});
  if (!opened) return tl::unexpected(opened.error());
  return Played{.calibration = opened->calibration_path.empty() ? opened->kind + " rig"
                                                                : opened->calibration_path,
                .rig = opened->rig,
                .source = std::move(opened->source)};
}

// The rig that the key names goes before the one that images bring along.
void add_calibration(const Config& config, const std::optional<Played>& played, CheckedEyes& eyes,
                     CheckRows& rows) {
  const std::string& path = config.service.calibration;
  if (!path.empty()) {
    const auto rig = load_calibration(path, configured_size(config.camera));
    if (!rig) {
      rows.wrong(kCalibration, {rig.error().code, "key 'calibration': " + rig.error().message});
      return;
    }
    eyes.rig = *rig;
    rows.ok(kCalibration, path);
  } else if (played) {
    eyes.rig = played->rig;
    rows.ok(kCalibration, played->calibration);
  } else if (!config.camera.source.empty()) {
    rows.wrong(kCalibration, {ExitCode::kConfiguration,
                              "key 'calibration': found nothing, a camera needs the file or folder "
                              "that calibrates it"});
    return;
  } else {
    rows.not_checked(kCalibration, "no SOURCE is given");
    return;
  }
  rows.ok("rig", rig_text(*eyes.rig));
}

// Whether each node is there, may be opened and captures.
Result<void> check_nodes(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const auto device = DeviceDescriptor::open(linux_device_calls(), path);
    if (!device) return tl::unexpected(device.error());
    if (const auto captures = check_captures(*device); !captures) return captures;
  }
  return {};
}

void add_v4l2(const Config& config, CheckedEyes& eyes, CheckRows& rows) {
  const auto paths = parse_v4l2(config.camera.source);
  if (!paths) {
    rows.wrong(kCamera, {ExitCode::kConfiguration, "key 'camera': " + paths.error().message});
    return;
  }
  if (const auto checked = check_nodes(*paths); !checked) {
    rows.wrong(kCamera, checked.error());
    return;
  }
  if (!eyes.rig) {
    rows.ok(kCamera, config.camera.source + " captures; formats need the calibration");
    return;
  }
  const ImageExtent eye{eyes.rig->left.width, eyes.rig->left.height};
  auto source = V4l2Source::create(config.camera, eye);
  if (!source) {
    rows.wrong(kCamera, {ExitCode::kConfiguration, "key 'camera': " + source.error().message});
    return;
  }
  // Started to see which format it agrees to; whoever wants images starts it again.
  const auto started = (*source)->start();
  if (!started) {
    rows.wrong(kCamera, started.error());
    return;
  }
  const std::vector<std::string> remarks = (*source)->remarks();
  (*source)->stop();
  if (remarks.empty()) {
    rows.ok(kCamera, config.camera.source);
  } else {
    std::string text = config.camera.source;
    for (const std::string& remark : remarks) text += "\n" + remark;
    rows.warning(kCamera, text);
  }
  eyes.source = std::move(*source);
}

void add_camera(const Config& config, const std::optional<Error>& not_played, CheckedEyes& eyes,
                CheckRows& rows) {
  const std::string& text = config.camera.source;
  if (text.empty()) {
    rows.not_checked(kCamera, "none is configured");
  } else if (text.starts_with(kV4l2)) {
    add_v4l2(config, eyes, rows);
  } else if (text.starts_with(kLibcamera)) {
    rows.not_checked(kCamera, text + ": libcamera is not asked here");
  } else if (not_played) {
    rows.wrong(kCamera,
               {not_played->code == ExitCode::kUsage ? ExitCode::kConfiguration : not_played->code,
                "key 'camera': " + not_played->message});
  } else if (text.starts_with(kSynthetic) || text.ends_with(kFrameLog)) {
    rows.ok(kCamera, text);
  } else {
    rows.wrong(kCamera, {ExitCode::kConfiguration,
                         "key 'camera': found '" + text +
                             "', allowed is v4l2:DEVICE[,DEVICE], libcamera:ID,ID, "
                             "synthetic:SCENE or a frame log (*.lcmlog)"});
  }
}

bool is_played(std::string_view camera) {
  return camera.starts_with(kSynthetic) || camera.ends_with(kFrameLog);
}

}  // namespace

CheckedEyes check_cameras(const Config& config, const std::string& recording, CheckRows& rows) {
  const bool is_camera_played = recording.empty() && is_played(config.camera.source);
  const std::string& played_text = is_camera_played ? config.camera.source : recording;
  CheckedEyes eyes;
  std::optional<Played> played;
  std::optional<Error> not_played;
  if (!played_text.empty()) {
    auto opened = open_played(played_text);
    if (opened) {
      played = std::move(*opened);
    } else {
      not_played = opened.error();
    }
  }
  if (not_played && !recording.empty()) {
    rows.wrong(kCalibration, *not_played);
  } else if (not_played && config.service.calibration.empty()) {
    rows.not_checked(kCalibration, "the camera would bring it along");
  } else {
    add_calibration(config, played, eyes, rows);
  }
  if (!recording.empty()) {
    rows.not_checked(kCamera, "a SOURCE is given");
  } else {
    add_camera(config, not_played, eyes, rows);
  }
  if (played) eyes.source = std::move(played->source);
  return eyes;
}

}  // namespace darkling
