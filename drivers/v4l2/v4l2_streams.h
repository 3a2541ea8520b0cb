// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "drivers/camera/camera_stream.h"
#include "drivers/v4l2/device_calls.h"

namespace darkling {

// V4L2 devices as streams that poll() waits for.
class V4l2Streams final : public CameraStreams {
 public:
  explicit V4l2Streams(DeviceCalls& calls) : calls_(calls) {}

  Result<std::unique_ptr<CameraStream>> open(const std::string& name, const CameraConfig& config,
                                             ImageExtent eye) override;
  void wait(std::span<CameraStream* const> wanted, Duration timeout) override;
  [[nodiscard]] MonotonicTime now() const override { return calls_.now(); }

 private:
  DeviceCalls& calls_;
};

}  // namespace darkling
