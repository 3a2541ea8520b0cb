// SPDX-License-Identifier: Apache-2.0
#include "vm/loopback_device.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace darkling::test {

namespace {

constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;

v4l2_buffer output_buffer(int index) {
  v4l2_buffer buffer = {};
  buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = static_cast<unsigned>(index);
  return buffer;
}

}  // namespace

LoopbackDevice::LoopbackDevice(const std::string& path, int width, int height)
    : path_(path), fd_(open(path.c_str(), O_RDWR | O_CLOEXEC)) {
  if (fd_ < 0) throw std::runtime_error(path + ": open: " + std::strerror(errno));
  v4l2_format format = {};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  format.fmt.pix.width = static_cast<unsigned>(width);
  format.fmt.pix.height = static_cast<unsigned>(height);
  format.fmt.pix.pixelformat = V4L2_PIX_FMT_GREY;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.bytesperline = format.fmt.pix.width;
  format.fmt.pix.sizeimage = format.fmt.pix.width * format.fmt.pix.height;
  control(VIDIOC_S_FMT, &format, "VIDIOC_S_FMT");
  map_buffers();
  int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  control(VIDIOC_STREAMON, &type, "VIDIOC_STREAMON");
}

LoopbackDevice::~LoopbackDevice() {
  for (const auto& buffer : buffers_) munmap(buffer.data(), buffer.size());
  close(fd_);
}

void LoopbackDevice::control(unsigned long request, void* argument, const char* what) const {
  if (ioctl(fd_, request, argument) == 0) return;
  throw std::runtime_error(path_ + ": " + what + ": " + std::strerror(errno));
}

void LoopbackDevice::map_buffers() {
  v4l2_requestbuffers request = {};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  request.memory = V4L2_MEMORY_MMAP;
  control(VIDIOC_REQBUFS, &request, "VIDIOC_REQBUFS");
  if (request.count != kBuffers)
    throw std::runtime_error(path_ + ": load v4l2loopback with max_buffers=4");
  for (int i = 0; i < kBuffers; ++i) {
    v4l2_buffer buffer = output_buffer(i);
    control(VIDIOC_QUERYBUF, &buffer, "VIDIOC_QUERYBUF");
    void* const memory = mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, fd_,
                              static_cast<off_t>(buffer.m.offset));
    if (memory == MAP_FAILED) throw std::runtime_error(path_ + ": mmap: " + std::strerror(errno));
    buffers_[static_cast<std::size_t>(i)] = {static_cast<std::uint8_t*>(memory), buffer.length};
  }
}

int LoopbackDevice::free_buffer() {
  if (used_buffers_ < kBuffers) return used_buffers_++;
  v4l2_buffer buffer = output_buffer(0);
  control(VIDIOC_DQBUF, &buffer, "VIDIOC_DQBUF");
  return static_cast<int>(buffer.index);
}

void LoopbackDevice::show(std::span<const std::uint8_t> pixels, std::int64_t stamp_us) {
  v4l2_buffer buffer = output_buffer(free_buffer());
  const auto memory = buffers_[buffer.index];
  if (memory.size() < pixels.size())
    throw std::runtime_error(path_ + ": its buffers are too small");
  std::copy(pixels.begin(), pixels.end(), memory.begin());
  buffer.bytesused = static_cast<unsigned>(pixels.size());
  buffer.field = V4L2_FIELD_NONE;
  buffer.timestamp.tv_sec = stamp_us / kMicrosecondsPerSecond;
  buffer.timestamp.tv_usec = stamp_us % kMicrosecondsPerSecond;
  control(VIDIOC_QBUF, &buffer, "VIDIOC_QBUF");
}

}  // namespace darkling::test
