// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace darkling::test {

// The writing end of a v4l2loopback device. The driver stamps and numbers what is written, and says
// of its stamps no more than that they are stamps.
// Throws std::runtime_error with device and errno on every failure.
class LoopbackDevice {
 public:
  LoopbackDevice(const std::string& path, int width, int height);
  ~LoopbackDevice();
  LoopbackDevice(const LoopbackDevice&) = delete;
  LoopbackDevice& operator=(const LoopbackDevice&) = delete;

  // Hands one grey image to whoever reads the device.
  // @param pixels  width * height, row by row.
  void show(std::span<const std::uint8_t> pixels) const;

 private:
  std::string path_;
  int fd_ = -1;
};

}  // namespace darkling::test
