// SPDX-License-Identifier: Apache-2.0
#include "app/service/open_camera.h"

#include "drivers/live/paced_source.h"
#include "drivers/live/rehearsed_source.h"
#include "drivers/synthetic/synthetic_source.h"

namespace darkling {

namespace {

constexpr std::string_view kSynthetic = "synthetic:";

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

}  // namespace

Result<LiveCamera> open_camera(const Config& config) {
  const std::string& source = config.camera.source;
  if (source.empty()) {
    return failure(ExitCode::kConfiguration,
                   "no camera is configured: set the key 'camera', as in "
                   "--set camera=v4l2:/dev/video0,/dev/video1 or --set camera=synthetic:mine");
  }
  if (source.starts_with(kSynthetic)) return open_scene(config);
  return failure(ExitCode::kConfiguration,
                 "key 'camera': found '" + source +
                     "', allowed is v4l2:DEVICE[,DEVICE], libcamera:ID,ID, synthetic:SCENE or a "
                     "frame log (*.lcmlog)");
}

}  // namespace darkling
