// SPDX-License-Identifier: Apache-2.0
#include "vm/loopback_device.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace darkling::test {

namespace {

[[noreturn]] void fail(const std::string& path, const char* call) {
  throw std::runtime_error(path + ": " + call + ": " + std::strerror(errno));
}

}  // namespace

LoopbackDevice::LoopbackDevice(const std::string& path, int width, int height)
    : path_(path), fd_(open(path.c_str(), O_RDWR | O_CLOEXEC)) {
  if (fd_ < 0) fail(path_, "open");
  v4l2_format format = {};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  format.fmt.pix.width = static_cast<unsigned>(width);
  format.fmt.pix.height = static_cast<unsigned>(height);
  format.fmt.pix.pixelformat = V4L2_PIX_FMT_GREY;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.bytesperline = format.fmt.pix.width;
  format.fmt.pix.sizeimage = format.fmt.pix.width * format.fmt.pix.height;
  if (ioctl(fd_, VIDIOC_S_FMT, &format) != 0) fail(path_, "VIDIOC_S_FMT");
}

LoopbackDevice::~LoopbackDevice() {
  close(fd_);
}

void LoopbackDevice::show(std::span<const std::uint8_t> pixels) const {
  const ssize_t written = write(fd_, pixels.data(), pixels.size());
  if (written != static_cast<ssize_t>(pixels.size())) fail(path_, "write");
}

}  // namespace darkling::test
