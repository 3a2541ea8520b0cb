// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <ctime>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "drivers/v4l2/device_calls.h"
#include "platform/clocks.h"

namespace darkling {

namespace {

// Makes a call again for as long as signals interrupt it.
template <class Call>
int retry(Call call) {
  int result = -1;
  do {
    result = call();
  } while (result < 0 && errno == EINTR);
  return result < 0 ? -errno : result;
}

timespec to_timespec(Duration duration) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  const std::int64_t ns = std::max<std::int64_t>(duration.count(), 0);
  timespec result = {};
  result.tv_sec = static_cast<time_t>(ns / kNsPerSecond);
  result.tv_nsec = static_cast<long>(ns % kNsPerSecond);
  return result;
}

class LinuxDeviceCalls final : public DeviceCalls {
 public:
  int open(const char* path) override {
    return retry([&] { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }

  // Not again after a signal: Linux has closed the descriptor by then.
  int close(int descriptor) override { return ::close(descriptor) < 0 ? -errno : 0; }

  int ioctl(int descriptor, unsigned long request, void* argument) override {
    return retry([&] { return ::ioctl(descriptor, request, argument); });
  }

  Mapped map(int descriptor, std::size_t bytes, std::int64_t offset) override {
    void* address = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor,
                           static_cast<off_t>(offset));
    if (address == MAP_FAILED) return {.address = nullptr, .error = -errno};
    return {.address = address, .error = 0};
  }

  int unmap(void* address, std::size_t bytes) override {
    return ::munmap(address, bytes) < 0 ? -errno : 0;
  }

  int poll(std::span<pollfd> wanted, Duration timeout) override {
    const MonotonicTime deadline = now() + timeout;
    return retry([&] {
      const timespec left = to_timespec(deadline - now());
      return ::ppoll(wanted.data(), wanted.size(), &left, nullptr);
    });
  }

  [[nodiscard]] MonotonicTime now() const override { return read_monotonic_clock(); }
};

}  // namespace

DeviceCalls& linux_device_calls() {
  static LinuxDeviceCalls calls;
  return calls;
}

}  // namespace darkling
