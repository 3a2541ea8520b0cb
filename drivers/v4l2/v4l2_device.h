// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/camera_config.h"
#include "base/result.h"
#include "drivers/camera/arrival_stamps.h"
#include "drivers/camera/camera_stream.h"
#include "drivers/v4l2/camera_controls.h"
#include "drivers/v4l2/capture_stamp.h"
#include "drivers/v4l2/device_descriptor.h"
#include "drivers/v4l2/negotiate_format.h"

namespace darkling {

// One capture node, set up and streaming into buffers that it shares with us. Whatever it does,
// it either goes on or is lost: then it is closed and opened anew.
// Thread: one at a time. After stream_on() nothing claims memory.
class V4l2Device {
 public:
  static constexpr int kBufferCount = 4;     // asked for; drivers may give others
  static constexpr int kMinBufferCount = 2;  // one that is filled, one that is looked at
  static constexpr int kMaxBufferCount = 8;  // more are not used

  // Opens and sets up the device and claims its buffers.
  // @param eye  the size that one eye must have.
  // @return kDeviceUnavailable with what is wrong and what to do.
  static Result<std::unique_ptr<V4l2Device>> open(DeviceCalls& calls, const std::string& path,
                                                  const CameraConfig& config, ImageExtent eye);
  // Stops the stream, then unmaps the buffers, then closes the node.
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  Result<void> stream_on();
  // The oldest full buffer. Never waits.
  TakenFrame take();
  // Lets the device fill the buffer again. A lost device is not bothered.
  void give_back(int buffer);
  // What poll() said of the device: loses it on an error, or when its format changes underneath.
  void note_events(short events);
  // Reads an automatic exposure again when the last reading is a second old.
  void refresh_exposure();

  [[nodiscard]] bool is_lost() const { return lost_call_ != nullptr; }
  // Why, in words. @pre is_lost().
  [[nodiscard]] std::string loss() const;
  [[nodiscard]] int descriptor() const { return descriptor_.number(); }
  // How many buffers the device has. With none, poll() has nothing to wait for.
  [[nodiscard]] int queued_count() const;
  [[nodiscard]] const std::uint8_t* pixels(int buffer) const { return buffers_[buffer].bytes(); }
  // How many bytes of a buffer that was taken the device says it has filled, and are there.
  [[nodiscard]] std::size_t filled_bytes(int buffer) const { return filled_bytes_.at(buffer); }
  [[nodiscard]] const ImageFormat& format() const { return format_; }
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  // All but the skew.
  [[nodiscard]] CameraState state() const;

 private:
  V4l2Device(DeviceDescriptor descriptor, const ImageFormat& format);

  Result<void> claim_buffers();
  Result<void> map_buffer(std::uint32_t index);
  int queue(int buffer);
  // Says in `frame` when the buffer was exposed.
  void stamp(const v4l2_buffer& buffer, TakenFrame& frame);
  // @return whether the buffer holds a whole image; may lose the device.
  bool is_whole(std::uint32_t flags, std::uint32_t bytes_used);
  void lose(const char* call, int error);

  DeviceDescriptor descriptor_;        // closed last:
  std::vector<MappedBuffer> buffers_;  // members go in reverse order
  std::array<bool, kMaxBufferCount> is_queued_ = {};
  std::array<std::size_t, kMaxBufferCount> filled_bytes_ = {};
  ImageFormat format_;
  Duration period_ = Duration::zero();  // 0: not known
  ExposureReading exposure_;
  bool is_automatic_ = false;
  MonotonicTime exposure_read_at_ = {};
  StampSource stamp_source_ = StampSource::kUnknown;
  ArrivalStamps arrivals_;
  bool is_streaming_ = false;
  const char* lost_call_ = nullptr;
  int lost_error_ = 0;
  std::vector<std::string> remarks_;
};

}  // namespace darkling
