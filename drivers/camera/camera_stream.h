// SPDX-License-Identifier: Apache-2.0
// What a kind of camera has to offer so that StreamSource makes stereo pairs of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/camera_config.h"
#include "base/result.h"
#include "base/time.h"
#include "drivers/camera/pixel_formats.h"
#include "drivers/frame_source.h"

namespace darkling {

enum class Taken {
  kNothing = 0,  // no buffer is full
  kFrame,        // `buffer` is the caller's until given back
  kBadBuffer,    // a frame that the device marked as bad or filled too little; given back already
  kLost,         // the device is of no use any more
};

struct [[nodiscard]] TakenFrame {
  Taken taken = Taken::kNothing;
  int buffer = -1;
  std::uint32_t sequence = 0;  // as the device counts
  FrameTime stamp = {};        // mid-exposure
  bool is_of_future = false;   // the device's own stamp, which its arrival gave way to
};

// One camera, set up and streaming into buffers that it shares with us. Whatever it does, it either
// goes on or is lost: then it is closed, by destruction, and opened anew.
// Thread: one at a time.
class CameraStream {
 public:
  virtual ~CameraStream() = default;

  virtual Result<void> stream_on() = 0;
  // The oldest full buffer. Never waits.
  virtual TakenFrame take() = 0;
  // Lets the camera fill the buffer again. A lost camera is not bothered.
  virtual void give_back(int buffer) = 0;
  // Where the image begins, of a buffer that was taken and not given back.
  [[nodiscard]] virtual const std::uint8_t* pixels(int buffer) const = 0;
  // How many bytes there are, which differs from image to image where they are compressed.
  [[nodiscard]] virtual std::size_t filled_bytes(int /*buffer*/) const { return format().bytes; }
  // Asks the camera again what it chose by itself, when the last answer is old.
  virtual void refresh_exposure() {}

  [[nodiscard]] virtual bool is_lost() const = 0;
  // Why, in words. @pre is_lost().
  [[nodiscard]] virtual std::string loss() const = 0;
  // How many buffers the camera has.
  [[nodiscard]] virtual int queued_count() const = 0;
  [[nodiscard]] virtual const ImageFormat& format() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& remarks() const = 0;
  // All but the skew.
  [[nodiscard]] virtual CameraState state() const = 0;
};

// The streams of one source, two at most, which are waited for together.
// Thread: one at a time.
class CameraStreams {
 public:
  virtual ~CameraStreams() = default;

  // Opens and sets up a camera and claims its buffers.
  // @param eye  the size that one eye must have.
  // @return kDeviceUnavailable with what is wrong and what to do.
  virtual Result<std::unique_ptr<CameraStream>> open(const std::string& name,
                                                     const CameraConfig& config,
                                                     ImageExtent eye) = 0;
  // Waits until one of `wanted`, all from here, may have something to take or is lost; for at most
  // `timeout`. Those that are null are passed over.
  virtual void wait(std::span<CameraStream* const> wanted, Duration timeout) = 0;
  // Every stream from here is closed.
  virtual void all_closed() {}
  [[nodiscard]] virtual MonotonicTime now() const = 0;
};

}  // namespace darkling
