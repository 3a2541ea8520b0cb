// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/camera_stream.h"
#include "drivers/libcamera/request_camera.h"

namespace darkling {

// The cameras of one source. The library runs from the first one opened to the last one closed.
class LibcameraStreams final : public CameraStreams {
 public:
  explicit LibcameraStreams(LibcameraCalls& calls) : calls_(calls) {}

  // @param name  as find_camera() takes it.
  Result<std::unique_ptr<CameraStream>> open(const std::string& name, const CameraConfig& config,
                                             ImageExtent eye) override;
  void wait(std::span<CameraStream* const> wanted, Duration timeout) override;
  void all_closed() override;
  [[nodiscard]] MonotonicTime now() const override;

 private:
  LibcameraCalls& calls_;
  Doorbell bell_;
  std::vector<std::string> opened_;
};

}  // namespace darkling
