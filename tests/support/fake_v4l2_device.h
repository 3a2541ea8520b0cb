// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <linux/videodev2.h>

#include "base/time.h"

namespace darkling::test {

struct FakeFormat {
  std::uint32_t fourcc = V4L2_PIX_FMT_GREY;
  std::uint32_t width = 32;
  std::uint32_t height = 16;
  std::uint32_t stride_bytes = 32;
  std::uint32_t image_bytes = 32 * 16;
};

struct FakeControl {
  std::int32_t value = 0;
  std::int32_t minimum = 0;
  std::int32_t maximum = 10000;
  std::int32_t step = 1;
};

// A camera as its driver in the kernel would show it, with whatever faults a test gives it. Frame k
// is ready at k periods, plus the phase, of the fake's clock; the frame's number is counted from
// the start of the stream, whether or not there was a buffer for it.
class FakeV4l2Device {
 public:
  // How it is made; to be set before it is opened.
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<FakeFormat> formats = {FakeFormat()};
  std::map<std::uint32_t, FakeControl> controls;
  std::uint32_t most_buffers = 4;
  std::uint32_t buffer_bytes = 0;  // 0: as many as the image
  Duration shortest_period = std::chrono::milliseconds(10);
  bool has_frame_rate = true;
  Duration phase = Duration::zero();
  Duration exposure = std::chrono::milliseconds(4);  // stamps are that long before the frame
  std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;

  // What goes wrong.
  int open_error = 0;                        // errno
  std::map<unsigned long, int> errors;       // errno of a request, every time
  std::function<int(unsigned long)> refuse;  // errno of a request, asked each time
  std::function<void(v4l2_buffer&)> alter;   // a full buffer's description
  // Fills the buffer of a frame in place of level(), and says with how many bytes.
  std::function<std::size_t(std::uint32_t sequence, std::uint8_t* bytes)> paint;
  int maps_allowed = 1000;
  bool is_stalled = false;
  bool is_gone = false;
  std::deque<std::uint32_t> events;  // types waiting to be told

  // What has been done to it, in order: "streamon", "streamoff", "map", "unmap", "close".
  std::vector<std::string> history;
  std::vector<std::string> violations;

  // Only for FakeV4l2.
  int ioctl(unsigned long request, void* argument, MonotonicTime now);
  void advance(MonotonicTime now);
  [[nodiscard]] MonotonicTime next_frame_at(MonotonicTime now) const;
  [[nodiscard]] short readiness() const;
  std::uint8_t* map(std::int64_t offset, std::size_t bytes);
  void unmap(const void* address);
  void close();
  [[nodiscard]] const FakeFormat& format() const { return format_; }
  // The grey level at a byte of frame `sequence`.
  [[nodiscard]] static std::uint8_t level(std::uint32_t sequence, std::size_t byte) {
    return static_cast<std::uint8_t>(sequence * 7 + byte);
  }

 private:
  int answer(unsigned long request, void* argument, MonotonicTime now);
  int answer_control(unsigned long request, void* argument);
  int answer_buffer(unsigned long request, v4l2_buffer& buffer);
  int list_format(v4l2_fmtdesc& description) const;
  int list_size(v4l2_frmsizeenum& size) const;
  void set_format(v4l2_pix_format& pixels);
  void tell_format(v4l2_pix_format& pixels) const;
  int set_rate(v4l2_streamparm& request);
  int request_buffers(v4l2_requestbuffers& request);
  int take_full(v4l2_buffer& buffer);
  void fill_next(MonotonicTime ready_at);

  FakeFormat format_;
  Duration period_ = std::chrono::milliseconds(50);
  std::vector<std::unique_ptr<std::uint8_t[]>> memory_;  // of mapped buffers, else null
  std::vector<bool> is_owned_;                           // by the device: queued or full
  std::deque<std::uint32_t> queued_;
  std::deque<v4l2_buffer> full_;
  bool is_streaming_ = false;
  MonotonicTime last_frame_at_ = {};
  std::uint32_t sequence_ = 0;
};

}  // namespace darkling::test
