// SPDX-License-Identifier: Apache-2.0
// Everything the driver asks of libcamera, so that a test can be libcamera, and a program that uses
// no such camera does without the library.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/camera_config.h"
#include "base/result.h"
#include "base/time.h"
#include "drivers/camera/pixel_formats.h"
#include "drivers/libcamera/completed_frames.h"
#include "platform/clocks.h"

namespace darkling {

struct CameraSetup {
  ImageFormat format;
  int buffer_count = 0;
  Duration period = Duration::zero();  // of frames, as asked for; 0: the camera chooses
  std::vector<std::string> remarks;    // what is not as asked for
};

// One camera with a request for each of its buffers; destruction stops it and gives it free.
// Thread: one at a time; libcamera's own brings the completed frames.
class RequestCamera {
 public:
  virtual ~RequestCamera() = default;

  [[nodiscard]] virtual const CameraSetup& setup() const = 0;
  // @return 0, or a negative error number, as of queue().
  virtual int start() = 0;
  // Queues the request of a buffer, a new one or one that has completed.
  virtual int queue(int buffer) = 0;
  // Makes what the camera wrote visible to the processor; until the buffer is queued again.
  virtual void begin_reading(int buffer) = 0;
  [[nodiscard]] virtual const std::uint8_t* pixels(int buffer) const = 0;
};

// Thread: one at a time.
class LibcameraCalls {
 public:
  virtual ~LibcameraCalls() = default;

  // The identifiers of all cameras. Starts the library, unless it runs.
  virtual Result<std::vector<std::string>> camera_ids() = 0;
  // @param completed  outlives the camera.
  // @return kDeviceUnavailable with what is wrong and what to do.
  virtual Result<std::unique_ptr<RequestCamera>> open(const std::string& id,
                                                      const CameraConfig& config, ImageExtent eye,
                                                      CompletedFrames& completed) = 0;
  // Stops the library. @pre every camera is closed.
  virtual void shut_down() = 0;
  [[nodiscard]] virtual MonotonicTime now() const { return read_monotonic_clock(); }
};

}  // namespace darkling
