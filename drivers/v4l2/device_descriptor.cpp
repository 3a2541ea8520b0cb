// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/device_descriptor.h"

#include <cerrno>
#include <system_error>
#include <utility>

namespace darkling {

namespace {

const char* advice(int error) {
  switch (-error) {
    case EBUSY:
      return "another program uses the camera; stop it, or name another device";
    case EACCES:
    case EPERM:
      return "no permission; the user of this program must join the group video";
    case ENOENT:
      return "there is no such device; is the camera plugged in?";
    case ENXIO:
    case ENODEV:
      return "the camera is gone; was it unplugged?";
    case ENOTTY:
      return "this is no V4L2 device; allowed: a capture node such as /dev/video0";
    case ENOMEM:
      return "the kernel has no memory for the camera's buffers";
    default:
      return nullptr;
  }
}

}  // namespace

Error device_error(const std::string& path, const char* call, int error) {
  std::string message = path + ": ";
  if (const char* hint = advice(error); hint != nullptr) message += std::string(hint) + " ";
  message += "(" + std::string(call) + ": " + std::generic_category().message(-error) + ")";
  return {.code = ExitCode::kDeviceUnavailable, .message = std::move(message)};
}

DeviceDescriptor::DeviceDescriptor(DeviceCalls& calls, std::string path, int number)
    : calls_(&calls), path_(std::move(path)), number_(number) {}

DeviceDescriptor::DeviceDescriptor(DeviceDescriptor&& other) noexcept
    : calls_(other.calls_),
      path_(std::move(other.path_)),
      number_(std::exchange(other.number_, -1)) {}

DeviceDescriptor::~DeviceDescriptor() {
  if (number_ >= 0) calls_->close(number_);
}

Result<DeviceDescriptor> DeviceDescriptor::open(DeviceCalls& calls, const std::string& path) {
  const int number = calls.open(path.c_str());
  if (number < 0) return tl::unexpected<Error>(device_error(path, "open", number));
  return DeviceDescriptor(calls, path, number);
}

MappedBuffer::MappedBuffer(DeviceCalls& calls, void* address, std::size_t size)
    : calls_(&calls), address_(address), size_(size) {}

MappedBuffer::MappedBuffer(MappedBuffer&& other) noexcept
    : calls_(other.calls_), address_(std::exchange(other.address_, nullptr)), size_(other.size_) {}

MappedBuffer::~MappedBuffer() {
  if (address_ != nullptr) calls_->unmap(address_, size_);
}

Result<MappedBuffer> MappedBuffer::map(const DeviceDescriptor& device, std::size_t bytes,
                                       std::int64_t offset) {
  const DeviceCalls::Mapped mapped = device.calls().map(device.number(), bytes, offset);
  if (mapped.address == nullptr) {
    return tl::unexpected<Error>(device_error(device.path(), "mmap", mapped.error));
  }
  return MappedBuffer(device.calls(), mapped.address, bytes);
}

}  // namespace darkling
