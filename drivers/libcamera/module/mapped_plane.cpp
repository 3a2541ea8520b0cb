// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/module/mapped_plane.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

namespace darkling {

namespace {

void synchronise(int descriptor, std::uint64_t flags) {
  dma_buf_sync request = {};
  request.flags = flags;
  int result = -1;
  do {
    result = ::ioctl(descriptor, DMA_BUF_IOCTL_SYNC, &request);
  } while (result < 0 && errno == EINTR);
}

}  // namespace

Result<MappedPlane> MappedPlane::map(const libcamera::FrameBuffer& buffer, std::size_t bytes) {
  if (buffer.planes().empty()) {
    return failure(ExitCode::kDeviceUnavailable, "its buffers have no planes");
  }
  const libcamera::FrameBuffer::Plane& plane = buffer.planes()[0];
  if (plane.offset == libcamera::FrameBuffer::Plane::kInvalidOffset || plane.length < bytes) {
    return failure(ExitCode::kDeviceUnavailable, "its buffers of " + std::to_string(plane.length) +
                                                     " bytes are too small for its images of " +
                                                     std::to_string(bytes));
  }
  // From the start: an offset into a mapping must be one of whole pages.
  const std::size_t mapped_bytes = std::size_t{plane.offset} + plane.length;
  void* address = ::mmap(nullptr, mapped_bytes, PROT_READ, MAP_SHARED, plane.fd.get(), 0);
  if (address == MAP_FAILED) {
    return failure(ExitCode::kDeviceUnavailable,
                   std::string("its buffers cannot be mapped: ") + std::strerror(errno));
  }
  return MappedPlane(address, mapped_bytes, plane.offset, plane.fd.get());
}

MappedPlane::~MappedPlane() {
  if (address_ != nullptr) ::munmap(address_, mapped_bytes_);
}

void MappedPlane::begin_reading() const {
  synchronise(descriptor_, DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ);
}

void MappedPlane::end_reading() const {
  synchronise(descriptor_, DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ);
}

}  // namespace darkling
