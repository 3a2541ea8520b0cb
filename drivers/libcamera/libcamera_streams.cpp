// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/libcamera_streams.h"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/libcamera/libcamera_spec.h"
#include "drivers/libcamera/libcamera_stream.h"

namespace darkling {

Result<std::unique_ptr<CameraStream>> LibcameraStreams::open(const std::string& name,
                                                             const CameraConfig& config,
                                                             ImageExtent eye) {
  const auto ids = calls_.camera_ids();
  if (!ids) return tl::unexpected<Error>(ids.error());
  const auto id = find_camera(name, *ids);
  if (!id) return tl::unexpected<Error>(id.error());
  if (std::find(opened_.begin(), opened_.end(), *id) != opened_.end()) {
    return failure(ExitCode::kDeviceUnavailable,
                   "libcamera camera \"" + *id + "\": both eyes are this camera");
  }
  auto completed = std::make_unique<CompletedFrames>(bell_);
  auto camera = calls_.open(*id, config, eye, *completed);
  if (!camera) return tl::unexpected<Error>(camera.error());
  opened_.push_back(*id);
  return std::make_unique<LibcameraStream>(*id, calls_, std::move(completed), std::move(*camera));
}

void LibcameraStreams::wait(std::span<CameraStream* const> wanted, Duration timeout) {
  std::array<const CompletedFrames*, 2> completed = {};
  CHECK(wanted.size() <= completed.size(), "a rig has two cameras at most");
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] == nullptr) continue;
    completed[i] = &static_cast<const LibcameraStream*>(wanted[i])->completed();
  }
  CompletedFrames::wait_for_any(bell_, completed, timeout);
}

void LibcameraStreams::all_closed() {
  opened_.clear();
  calls_.shut_down();
}

MonotonicTime LibcameraStreams::now() const {
  return calls_.now();
}

}  // namespace darkling
