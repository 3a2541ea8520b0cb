// SPDX-License-Identifier: Apache-2.0
#include "support/fake_v4l2_device.h"

#include <algorithm>
#include <cerrno>

#include <poll.h>

namespace darkling::test {

int FakeV4l2Device::ioctl(unsigned long request, void* argument, MonotonicTime now) {
  if (is_gone) return -ENODEV;
  if (const auto error = errors.find(request); error != errors.end()) return -error->second;
  if (refuse) {
    if (const int error = refuse(request); error != 0) return -error;
  }
  return answer(request, argument, now);
}

int FakeV4l2Device::answer(unsigned long request, void* argument, MonotonicTime now) {
  switch (request) {
    case VIDIOC_QUERYCAP:
      static_cast<v4l2_capability*>(argument)->capabilities = V4L2_CAP_DEVICE_CAPS | capabilities;
      static_cast<v4l2_capability*>(argument)->device_caps = capabilities;
      return 0;
    case VIDIOC_ENUM_FMT:
      return list_format(*static_cast<v4l2_fmtdesc*>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return list_size(*static_cast<v4l2_frmsizeenum*>(argument));
    case VIDIOC_S_FMT:
      set_format(static_cast<v4l2_format*>(argument)->fmt.pix);
      return 0;
    case VIDIOC_G_FMT:
      tell_format(static_cast<v4l2_format*>(argument)->fmt.pix);
      return 0;
    case VIDIOC_S_PARM:
      return set_rate(*static_cast<v4l2_streamparm*>(argument));
    case VIDIOC_REQBUFS:
      return request_buffers(*static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_STREAMON:
      is_streaming_ = true;
      last_frame_at_ = now;
      sequence_ = 0;
      history.emplace_back("streamon");
      return 0;
    case VIDIOC_STREAMOFF:
      is_streaming_ = false;
      queued_.clear();
      full_.clear();
      is_owned_.assign(is_owned_.size(), false);
      history.emplace_back("streamoff");
      return 0;
    case VIDIOC_SUBSCRIBE_EVENT:
      return 0;
    case VIDIOC_DQEVENT:
      if (events.empty()) return -ENOENT;
      static_cast<v4l2_event*>(argument)->type = events.front();
      events.pop_front();
      return 0;
    case VIDIOC_QUERYBUF:
    case VIDIOC_QBUF:
    case VIDIOC_DQBUF:
      return answer_buffer(request, *static_cast<v4l2_buffer*>(argument));
    default:
      return answer_control(request, argument);
  }
}

int FakeV4l2Device::answer_control(unsigned long request, void* argument) {
  if (request == VIDIOC_QUERYCTRL) {
    auto& range = *static_cast<v4l2_queryctrl*>(argument);
    const auto found = controls.find(range.id);
    if (found == controls.end()) return -EINVAL;
    range.minimum = found->second.minimum;
    range.maximum = found->second.maximum;
    range.step = found->second.step;
    return 0;
  }
  if (request != VIDIOC_G_CTRL && request != VIDIOC_S_CTRL) return -ENOTTY;
  auto& control = *static_cast<v4l2_control*>(argument);
  const auto found = controls.find(control.id);
  if (found == controls.end()) return -EINVAL;
  if (request == VIDIOC_G_CTRL) {
    control.value = found->second.value;
    return 0;
  }
  if (control.value < found->second.minimum || control.value > found->second.maximum) {
    return -ERANGE;
  }
  found->second.value = control.value;
  return 0;
}

int FakeV4l2Device::answer_buffer(unsigned long request, v4l2_buffer& buffer) {
  if (request == VIDIOC_DQBUF) return take_full(buffer);
  if (buffer.index >= memory_.size()) return -EINVAL;
  if (request == VIDIOC_QUERYBUF) {
    buffer.length = buffer_bytes != 0 ? buffer_bytes : format_.image_bytes;
    buffer.m.offset = buffer.index * 0x1000;
    return 0;
  }
  if (is_owned_[buffer.index]) {
    violations.emplace_back("a buffer was queued twice");
    return -EINVAL;
  }
  if (memory_[buffer.index] == nullptr) violations.emplace_back("a buffer was queued unmapped");
  is_owned_[buffer.index] = true;
  queued_.push_back(buffer.index);
  return 0;
}

int FakeV4l2Device::list_format(v4l2_fmtdesc& description) const {
  std::vector<std::uint32_t> fourccs;
  for (const FakeFormat& format : formats) {
    if (std::find(fourccs.begin(), fourccs.end(), format.fourcc) == fourccs.end()) {
      fourccs.push_back(format.fourcc);
    }
  }
  if (description.index >= fourccs.size()) return -EINVAL;
  description.pixelformat = fourccs[description.index];
  return 0;
}

int FakeV4l2Device::list_size(v4l2_frmsizeenum& size) const {
  std::uint32_t index = 0;
  for (const FakeFormat& format : formats) {
    if (format.fourcc != size.pixel_format || index++ != size.index) continue;
    size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
    size.discrete.width = format.width;
    size.discrete.height = format.height;
    return 0;
  }
  return -EINVAL;
}

// As drivers do: what it cannot give becomes something that it can.
void FakeV4l2Device::set_format(v4l2_pix_format& pixels) {
  const auto is_asked = [&](const FakeFormat& format) {
    return format.fourcc == pixels.pixelformat && format.width == pixels.width &&
           format.height == pixels.height;
  };
  const auto found = std::find_if(formats.begin(), formats.end(), is_asked);
  format_ = found != formats.end() ? *found : formats.front();
  tell_format(pixels);
}

void FakeV4l2Device::tell_format(v4l2_pix_format& pixels) const {
  pixels.pixelformat = format_.fourcc;
  pixels.width = format_.width;
  pixels.height = format_.height;
  pixels.bytesperline = format_.stride_bytes;
  pixels.sizeimage = format_.image_bytes;
  pixels.field = V4L2_FIELD_NONE;
}

int FakeV4l2Device::set_rate(v4l2_streamparm& request) {
  if (!has_frame_rate) return -ENOTTY;
  v4l2_fract& period = request.parm.capture.timeperframe;
  const double asked_ns = 1e9 * period.numerator / period.denominator;
  period_ = std::max(shortest_period, Duration{static_cast<std::int64_t>(asked_ns)});
  request.parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
  period = {.numerator = static_cast<std::uint32_t>(period_.count() / 1000),
            .denominator = 1'000'000};
  return 0;
}

int FakeV4l2Device::request_buffers(v4l2_requestbuffers& request) {
  request.count = std::min(request.count, most_buffers);
  memory_.resize(request.count);
  is_owned_.assign(request.count, false);
  return 0;
}

int FakeV4l2Device::take_full(v4l2_buffer& buffer) {
  if (full_.empty()) return -EAGAIN;
  buffer = full_.front();
  full_.pop_front();
  if (alter) alter(buffer);
  if (buffer.index < is_owned_.size()) is_owned_[buffer.index] = false;  // whatever it says it is
  return 0;
}

MonotonicTime FakeV4l2Device::next_frame_at(MonotonicTime now) const {
  if (!is_streaming_ || is_stalled || is_gone) return MonotonicTime::max();
  const std::int64_t passed = (now - phase).time_since_epoch() / period_;
  return MonotonicTime{(passed + 1) * period_ + phase};
}

void FakeV4l2Device::advance(MonotonicTime now) {
  while (is_streaming_ && !is_stalled && next_frame_at(last_frame_at_) <= now) {
    last_frame_at_ = next_frame_at(last_frame_at_);
    fill_next(last_frame_at_);
  }
  if (is_stalled) last_frame_at_ = now;
}

void FakeV4l2Device::fill_next(MonotonicTime ready_at) {
  const std::uint32_t sequence = sequence_++;
  if (queued_.empty()) return;
  v4l2_buffer buffer = {};
  buffer.index = queued_.front();
  queued_.pop_front();
  for (std::size_t i = 0; i < format_.image_bytes; ++i) {
    memory_[buffer.index][i] = level(sequence, i);
  }
  const std::int64_t stamp_us = to_ns(ready_at - exposure) / 1000;
  buffer.timestamp.tv_sec = static_cast<time_t>(stamp_us / 1'000'000);
  buffer.timestamp.tv_usec = static_cast<suseconds_t>(stamp_us % 1'000'000);
  buffer.sequence = sequence;
  buffer.flags = stamp_flags;
  buffer.bytesused = format_.image_bytes;
  if (paint) {
    buffer.bytesused = static_cast<std::uint32_t>(paint(sequence, memory_[buffer.index].get()));
  }
  full_.push_back(buffer);
}

short FakeV4l2Device::readiness() const {
  if (is_gone) return POLLERR | POLLHUP;
  const int readable = full_.empty() ? 0 : POLLIN;
  const int eventful = events.empty() ? 0 : POLLPRI;
  return static_cast<short>(readable | eventful);
}

std::uint8_t* FakeV4l2Device::map(std::int64_t offset, std::size_t bytes) {
  const std::size_t index = static_cast<std::size_t>(offset) / 0x1000;
  if (maps_allowed-- <= 0 || index >= memory_.size()) return nullptr;
  history.emplace_back("map");
  memory_[index] =
      std::make_unique<std::uint8_t[]>(std::max<std::size_t>(bytes, format_.image_bytes));
  return memory_[index].get();
}

void FakeV4l2Device::unmap(const void* address) {
  if (is_streaming_ && !is_gone) violations.emplace_back("a buffer was unmapped while streaming");
  history.emplace_back("unmap");
  for (auto& memory : memory_) {
    if (memory.get() == address) memory.reset();
  }
}

void FakeV4l2Device::close() {
  const bool is_mapped = std::any_of(memory_.begin(), memory_.end(),
                                     [](const auto& memory) { return memory != nullptr; });
  if (is_mapped) violations.emplace_back("closed with buffers mapped");
  history.emplace_back("close");
  is_streaming_ = false;
  queued_.clear();
  full_.clear();
}

}  // namespace darkling::test
