// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace darkling::test {

// The writing end of a v4l2loopback device. Buffers are queued, not written, because only then the
// stamp is the writer's choice: both eyes of a pair get the same one, as from one trigger.
// Throws std::runtime_error with device and errno on every failure.
class LoopbackDevice {
 public:
  LoopbackDevice(const std::string& path, int width, int height);
  ~LoopbackDevice();
  LoopbackDevice(const LoopbackDevice&) = delete;
  LoopbackDevice& operator=(const LoopbackDevice&) = delete;

  // Hands one grey image to whoever reads the device.
  // @param pixels  width * height, row by row.
  // @param stamp_us  of CLOCK_MONOTONIC; not 0.
  void show(std::span<const std::uint8_t> pixels, std::int64_t stamp_us);

 private:
  // No more than a reader asks for: the driver has one set of buffers for both ends, as many as the
  // end that wants fewer, and goes on to hand out the first of them only.
  static constexpr int kBuffers = 4;

  void control(unsigned long request, void* argument, const char* what) const;
  void map_buffers();
  int free_buffer();

  std::string path_;
  int fd_ = -1;
  std::array<std::span<std::uint8_t>, kBuffers> buffers_;
  int used_buffers_ = 0;  // those not yet used come first
};

}  // namespace darkling::test
