// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <libcamera/camera.h>
#include <libcamera/framebuffer_allocator.h>

#include "drivers/libcamera/module/mapped_plane.h"
#include "drivers/libcamera/request_camera.h"

namespace darkling {

// A camera of libcamera's.
// Thread: libcamera's own calls the two slots.
class DeviceCamera final : public RequestCamera {
 public:
  static Result<std::unique_ptr<RequestCamera>> open(std::shared_ptr<libcamera::Camera> camera,
                                                     const CameraConfig& config, ImageExtent eye,
                                                     CompletedFrames& completed);
  // Stops; frees requests, mappings and buffers, in this order; gives the camera free.
  ~DeviceCamera() override;
  DeviceCamera(const DeviceCamera&) = delete;
  DeviceCamera& operator=(const DeviceCamera&) = delete;

  [[nodiscard]] const CameraSetup& setup() const override { return setup_; }
  int start() override;
  int queue(int buffer) override;
  void begin_reading(int buffer) override;
  [[nodiscard]] const std::uint8_t* pixels(int buffer) const override {
    return planes_[buffer].bytes();
  }

 private:
  DeviceCamera(std::shared_ptr<libcamera::Camera> camera, CompletedFrames& completed);

  Result<void> acquire();
  Result<void> set_up(const CameraConfig& config, ImageExtent eye);
  Result<void> claim_buffers();
  tl::unexpected<Error> refuse(const std::string& what) const;

  void on_completed(libcamera::Request* request);
  void on_disconnected() { completed_.disconnect(); }

  const std::shared_ptr<libcamera::Camera> camera_;
  CompletedFrames& completed_;
  bool is_acquired_ = false;
  CameraSetup setup_;
  std::unique_ptr<libcamera::CameraConfiguration> configuration_;
  libcamera::Stream* stream_ = nullptr;
  libcamera::ControlList start_controls_;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::vector<MappedPlane> planes_;
  std::vector<bool> is_read_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;
};

}  // namespace darkling
