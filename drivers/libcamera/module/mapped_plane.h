// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include <libcamera/framebuffer.h>

#include "base/result.h"

namespace darkling {

// The first plane of a camera's buffer, readable. Move-only.
class MappedPlane {
 public:
  // @return kDeviceUnavailable when the buffer holds less than `bytes` or cannot be mapped.
  static Result<MappedPlane> map(const libcamera::FrameBuffer& buffer, std::size_t bytes);
  MappedPlane(MappedPlane&& other) noexcept
      : address_(std::exchange(other.address_, nullptr)),
        mapped_bytes_(other.mapped_bytes_),
        offset_bytes_(other.offset_bytes_),
        descriptor_(other.descriptor_) {}
  MappedPlane& operator=(MappedPlane&&) = delete;
  ~MappedPlane();

  [[nodiscard]] const std::uint8_t* bytes() const {
    return static_cast<const std::uint8_t*>(address_) + offset_bytes_;
  }
  // Around reading: the processor's caches may hold what was there before. Buffers that need no
  // such care refuse, which does no harm.
  void begin_reading() const;
  void end_reading() const;

 private:
  MappedPlane(void* address, std::size_t mapped_bytes, std::size_t offset_bytes, int descriptor)
      : address_(address),
        mapped_bytes_(mapped_bytes),
        offset_bytes_(offset_bytes),
        descriptor_(descriptor) {}

  void* address_ = nullptr;
  std::size_t mapped_bytes_ = 0;
  std::size_t offset_bytes_ = 0;
  int descriptor_ = -1;  // the buffer's
};

}  // namespace darkling
