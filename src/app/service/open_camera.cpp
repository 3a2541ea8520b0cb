// SPDX-License-Identifier: Apache-2.0
#include "app/service/open_camera.h"

#include "drivers/framelog/frame_log.h"
#include "drivers/framelog/framelog_source.h"
#include "drivers/libcamera/libcamera_source.h"
#include "drivers/live/paced_source.h"
#include "drivers/live/rehearsed_source.h"
#include "drivers/synthetic/synthetic_source.h"
#include "drivers/v4l2/v4l2_source.h"
#include "io/calibration.h"

namespace darkling {

namespace {

constexpr std::string_view kSynthetic = "synthetic:";
constexpr std::string_view kV4l2 = "v4l2:";
constexpr std::string_view kLibcamera = "libcamera:";
constexpr std::string_view kFrameLog = ".lcmlog";

// A scene is rendered once and then driven to and fro: no processor renders it at a camera's pace
// and has time for anything else.
Result<LiveCamera> open_scene(const Config& config) {
  const auto spec = parse_synthetic(config.camera.source);
  if (!spec) return failure(ExitCode::kConfiguration, "key 'camera': " + spec.error().message);
  auto scene = SyntheticSource::create(*spec);
  if (!scene) return failure(ExitCode::kConfiguration, "key 'camera': " + scene.error().message);
  const StereoRig rig = (*scene)->rig();
  auto rehearsed = std::make_unique<RehearsedSource>(std::move(*scene), config.camera.rate_hz);
  return LiveCamera{.name = config.camera.source,
                    .source = std::make_unique<PacedSource>(std::move(rehearsed)),
                    .rig = rig};
}

Result<StereoRig> load_rig(const Config& config) {
  const std::string& path = config.service.calibration;
  if (path.empty()) {
    return failure(ExitCode::kConfiguration,
                   "key 'calibration' is empty: cameras need one, name its file or folder");
  }
  return load_calibration(path);
}

Result<LiveCamera> open_v4l2(const Config& config) {
  const auto rig = load_rig(config);
  if (!rig) return tl::unexpected(rig.error());
  auto source = V4l2Source::create(config.camera, {rig->left.width, rig->left.height});
  if (!source) return failure(ExitCode::kConfiguration, source.error().message);
  return LiveCamera{.name = config.camera.source, .source = std::move(*source), .rig = *rig};
}

Result<LiveCamera> open_libcamera(const Config& config) {
  const auto rig = load_rig(config);
  if (!rig) return tl::unexpected(rig.error());
  auto source = create_libcamera_source(config.camera, {rig->left.width, rig->left.height});
  if (!source) {
    return failure(ExitCode::kConfiguration, "key 'camera': " + source.error().message);
  }
  return LiveCamera{.name = config.camera.source, .source = std::move(*source), .rig = *rig};
}

Result<LiveCamera> open_log(const Config& config) {
  auto log = open_frame_log(config.camera.source);
  if (!log) return tl::unexpected(log.error());
  const StereoRig rig = log->rig;
  auto source = std::make_unique<FramelogSource>(std::move(log->events), std::move(log->rows));
  return LiveCamera{.name = config.camera.source,
                    .source = std::make_unique<PacedSource>(std::move(source)),
                    .rig = rig};
}

}  // namespace

Result<LiveCamera> open_camera(const Config& config) {
  const std::string& source = config.camera.source;
  if (source.empty()) {
    return failure(ExitCode::kConfiguration,
                   "no camera is configured: set the key 'camera', as in "
                   "--set camera=v4l2:/dev/video0,/dev/video1 or --set camera=synthetic:mine");
  }
  if (source.starts_with(kSynthetic)) return open_scene(config);
  if (source.starts_with(kV4l2)) return open_v4l2(config);
  if (source.starts_with(kLibcamera)) return open_libcamera(config);
  if (source.ends_with(kFrameLog)) return open_log(config);
  return failure(ExitCode::kConfiguration,
                 "key 'camera': found '" + source +
                     "', allowed is v4l2:DEVICE[,DEVICE], libcamera:ID[,ID], synthetic:SCENE or a "
                     "frame log (*.lcmlog)");
}

}  // namespace darkling
