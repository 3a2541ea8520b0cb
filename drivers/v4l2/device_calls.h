// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <poll.h>

#include "base/time.h"

namespace darkling {

// Everything the driver asks of the operating system, so that a test can be the operating system.
// Calls that a signal interrupts are made again. Whatever fails gives the negative error number.
// Thread: the device's own.
class DeviceCalls {
 public:
  struct Mapped {
    void* address = nullptr;
    int error = 0;  // negative when there is no address
  };

  virtual ~DeviceCalls() = default;
  // For reading and writing, without blocking. @return the descriptor.
  virtual int open(const char* path) = 0;
  virtual int close(int descriptor) = 0;
  virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  // Shared, readable and writable.
  virtual Mapped map(int descriptor, std::size_t bytes, std::int64_t offset) = 0;
  virtual int unmap(void* address, std::size_t bytes) = 0;
  // Waits for at most `timeout`. @return how many of `wanted` have something to say.
  virtual int poll(std::span<pollfd> wanted, Duration timeout) = 0;
  [[nodiscard]] virtual MonotonicTime now() const = 0;
};

// The real ones. Thread: any.
[[nodiscard]] DeviceCalls& linux_device_calls();

}  // namespace darkling
