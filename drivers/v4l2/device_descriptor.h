// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/result.h"
#include "drivers/v4l2/device_calls.h"

namespace darkling {

// An open device node: closed when this goes. Move-only.
class DeviceDescriptor {
 public:
  // @return kDeviceUnavailable when there is no such node, or it may not be opened.
  static Result<DeviceDescriptor> open(DeviceCalls& calls, const std::string& path);
  DeviceDescriptor(DeviceDescriptor&& other) noexcept;
  DeviceDescriptor& operator=(DeviceDescriptor&&) = delete;
  ~DeviceDescriptor();

  // @return 0 or the negative error number.
  int ioctl(unsigned long request, void* argument) const {
    return calls_->ioctl(number_, request, argument);
  }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] DeviceCalls& calls() const { return *calls_; }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  DeviceDescriptor(DeviceCalls& calls, std::string path, int number);

  DeviceCalls* calls_;
  std::string path_;
  int number_;
};

// One buffer of a device in our address space: unmapped when this goes. Move-only.
class MappedBuffer {
 public:
  // @return kDeviceUnavailable when the kernel refuses.
  static Result<MappedBuffer> map(const DeviceDescriptor& device, std::size_t bytes,
                                  std::int64_t offset);
  MappedBuffer(MappedBuffer&& other) noexcept;
  MappedBuffer& operator=(MappedBuffer&&) = delete;
  ~MappedBuffer();

  [[nodiscard]] const std::uint8_t* bytes() const {
    return static_cast<const std::uint8_t*>(address_);
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  MappedBuffer(DeviceCalls& calls, void* address, std::size_t size);

  DeviceCalls* calls_;
  void* address_;
  std::size_t size_;
};

// What went wrong with the device at `path` and what can be done about it.
// @param call   what was asked of it: "VIDIOC_S_FMT".
// @param error  the negative error number.
[[nodiscard]] Error device_error(const std::string& path, const char* call, int error);

}  // namespace darkling
