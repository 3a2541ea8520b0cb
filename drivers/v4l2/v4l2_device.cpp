// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_device.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <linux/videodev2.h>

namespace darkling {

namespace {

constexpr Duration kExposureAge = std::chrono::seconds(1);
// Said in place of an error number when the device itself never failed.
constexpr const char* kFormatChanged = "the image format changed underneath";
constexpr const char* kForeignBuffer = "VIDIOC_DQBUF gave a buffer that was not queued";
constexpr const char* kPollError = "poll reported an error or a hang-up";

v4l2_buffer capture_buffer(std::uint32_t index) {
  v4l2_buffer buffer = {};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

// Not every driver has events; those without cannot change their format either.
void subscribe_to_changes(const DeviceDescriptor& descriptor) {
  v4l2_event_subscription subscription = {};
  subscription.type = V4L2_EVENT_SOURCE_CHANGE;
  (void)descriptor.ioctl(VIDIOC_SUBSCRIBE_EVENT, &subscription);
}

}  // namespace

Result<std::unique_ptr<V4l2Device>> V4l2Device::open(DeviceCalls& calls, const std::string& path,
                                                     const CameraConfig& config, ImageExtent eye) {
  auto descriptor = DeviceDescriptor::open(calls, path);
  if (!descriptor) return tl::unexpected<Error>(descriptor.error());
  const auto format = negotiate_format(*descriptor, config, eye);
  if (!format) return tl::unexpected<Error>(format.error());
  std::unique_ptr<V4l2Device> device(new V4l2Device(std::move(*descriptor), *format));
  device->period_ = set_frame_rate(device->descriptor_, config.rate_hz, device->remarks_);
  set_exposure(device->descriptor_, config, device->period_, device->remarks_);
  device->is_automatic_ = config.exposure_ms <= 0.0;
  device->exposure_ = read_exposure(device->descriptor_);
  device->exposure_read_at_ = calls.now();
  subscribe_to_changes(device->descriptor_);
  if (auto claimed = device->claim_buffers(); !claimed) {
    return tl::unexpected<Error>(claimed.error());
  }
  return device;
}

V4l2Device::V4l2Device(DeviceDescriptor descriptor, const ImageFormat& format)
    : descriptor_(std::move(descriptor)), format_(format) {}

V4l2Device::~V4l2Device() {
  if (!is_streaming_) return;
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  (void)descriptor_.ioctl(VIDIOC_STREAMOFF, &type);  // a device that is gone has stopped
}

Result<void> V4l2Device::claim_buffers() {
  v4l2_requestbuffers request = {};
  request.count = kBufferCount;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = descriptor_.ioctl(VIDIOC_REQBUFS, &request); error < 0) {
    return tl::unexpected<Error>(device_error(descriptor_.path(), "VIDIOC_REQBUFS", error));
  }
  if (request.count < kMinBufferCount) {
    return failure(ExitCode::kDeviceUnavailable,
                   descriptor_.path() + ": gives " + std::to_string(request.count) +
                       " buffers; at least " + std::to_string(kMinBufferCount) + " are needed");
  }
  const std::uint32_t count = std::min<std::uint32_t>(request.count, kMaxBufferCount);
  buffers_.reserve(count);
  for (std::uint32_t index = 0; index < count; ++index) {
    if (auto mapped = map_buffer(index); !mapped) return mapped;
  }
  return {};
}

Result<void> V4l2Device::map_buffer(std::uint32_t index) {
  v4l2_buffer buffer = capture_buffer(index);
  if (const int error = descriptor_.ioctl(VIDIOC_QUERYBUF, &buffer); error < 0) {
    return tl::unexpected<Error>(device_error(descriptor_.path(), "VIDIOC_QUERYBUF", error));
  }
  if (buffer.length < format_.bytes) {
    return failure(ExitCode::kDeviceUnavailable,
                   descriptor_.path() + ": its buffers of " + std::to_string(buffer.length) +
                       " bytes are too small for its images of " + std::to_string(format_.bytes));
  }
  auto mapped = MappedBuffer::map(descriptor_, buffer.length, buffer.m.offset);
  if (!mapped) return tl::unexpected<Error>(mapped.error());
  buffers_.push_back(std::move(*mapped));
  return {};
}

Result<void> V4l2Device::stream_on() {
  for (int buffer = 0; buffer < static_cast<int>(buffers_.size()); ++buffer) {
    if (const int error = queue(buffer); error < 0) {
      return tl::unexpected<Error>(device_error(descriptor_.path(), "VIDIOC_QBUF", error));
    }
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int error = descriptor_.ioctl(VIDIOC_STREAMON, &type); error < 0) {
    return tl::unexpected<Error>(device_error(descriptor_.path(), "VIDIOC_STREAMON", error));
  }
  is_streaming_ = true;
  return {};
}

int V4l2Device::queue(int buffer) {
  v4l2_buffer request = capture_buffer(static_cast<std::uint32_t>(buffer));
  const int error = descriptor_.ioctl(VIDIOC_QBUF, &request);
  is_queued_[buffer] = error == 0;
  return error;
}

TakenFrame V4l2Device::take() {
  if (is_lost()) return {.taken = Taken::kLost};
  v4l2_buffer buffer = capture_buffer(0);
  const int error = descriptor_.ioctl(VIDIOC_DQBUF, &buffer);
  if (error == -EAGAIN) return {.taken = Taken::kNothing};
  if (error < 0) {
    lose("VIDIOC_DQBUF", error);
    return {.taken = Taken::kLost};
  }
  if (buffer.index >= buffers_.size() || !is_queued_[buffer.index]) {
    lose(kForeignBuffer, 0);
    return {.taken = Taken::kLost};
  }
  const int index = static_cast<int>(buffer.index);
  is_queued_[index] = false;
  filled_bytes_[index] = std::min<std::size_t>(buffer.bytesused, buffers_[index].size());
  TakenFrame frame = {.taken = Taken::kFrame, .buffer = index, .sequence = buffer.sequence};
  stamp(buffer, frame);
  if (!is_whole(buffer.flags, buffer.bytesused)) {
    give_back(index);
    frame.taken = is_lost() ? Taken::kLost : Taken::kBadBuffer;
    frame.buffer = -1;
  }
  return frame;
}

void V4l2Device::stamp(const v4l2_buffer& buffer, TakenFrame& frame) {
  const MonotonicTime now = descriptor_.calls().now();
  const FrameTime arrival = frame_time_from_ns(to_ns(now));
  const CaptureStamp said = stamp_capture(buffer, now, exposure_.exposure_ms);
  stamp_source_ = said.source;
  frame.is_of_future = said.is_of_future;
  frame.stamp = said.is_of_future ? arrivals_.estimate(arrival, said.middle)
                                  : arrivals_.note(said.middle, arrival);
}

bool V4l2Device::is_whole(std::uint32_t flags, std::uint32_t bytes_used) {
  const bool is_filled = bytes_used >= format_.bytes;
  if ((flags & V4L2_BUF_FLAG_ERROR) == 0 && is_filled) return true;
  // Too little may be a torn transfer, or all that another format needs.
  if (!is_filled && !has_format(descriptor_, format_)) lose(kFormatChanged, 0);
  return false;
}

void V4l2Device::give_back(int buffer) {
  if (is_lost()) return;
  CHECK(!is_queued_[buffer], "a buffer is given back once");
  if (const int error = queue(buffer); error < 0) lose("VIDIOC_QBUF", error);
}

void V4l2Device::note_events(short events) {
  if (is_lost()) return;
  if ((events & (POLLERR | POLLHUP | POLLNVAL)) != 0) return lose(kPollError, 0);
  if ((events & POLLPRI) == 0) return;
  v4l2_event event = {};
  if (descriptor_.ioctl(VIDIOC_DQEVENT, &event) < 0) return;
  if (event.type == V4L2_EVENT_SOURCE_CHANGE) lose(kFormatChanged, 0);
}

void V4l2Device::refresh_exposure() {
  const MonotonicTime now = descriptor_.calls().now();
  if (is_lost() || !is_automatic_ || now < exposure_read_at_ + kExposureAge) return;
  exposure_ = read_exposure(descriptor_);
  exposure_read_at_ = now;
}

void V4l2Device::lose(const char* call, int error) {
  if (is_lost()) return;
  lost_call_ = call;
  lost_error_ = error;
}

std::string V4l2Device::loss() const {
  CHECK(is_lost(), "only a lost device says how it was lost");
  if (lost_error_ == 0) return descriptor_.path() + ": lost, " + lost_call_;
  return device_error(descriptor_.path(), lost_call_, lost_error_).message;
}

int V4l2Device::queued_count() const {
  return static_cast<int>(std::count(is_queued_.begin(), is_queued_.end(), true));
}

CameraState V4l2Device::state() const {
  CameraState state;
  state.exposure_ms = exposure_.exposure_ms;
  state.gain = exposure_.gain;
  state.rate_hz = period_ > Duration::zero() ? 1e9 / static_cast<double>(period_.count()) : -1.0;
  state.stamp_source = stamp_source_;
  state.stamp_uncertainty =
      stamp_uncertainty(stamp_source_, exposure_.exposure_ms, is_automatic_, period_);
  return state;
}

}  // namespace darkling
