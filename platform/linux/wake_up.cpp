// SPDX-License-Identifier: Apache-2.0
#include "platform/wake_up.h"

#include <algorithm>
#include <cstdint>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "base/check.h"

namespace darkling {

WakeUp::WakeUp() : fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  CHECK(fd_ >= 0, "a process may have a few more open files");
}

WakeUp::~WakeUp() {
  close(fd_);
}

void WakeUp::notify() {
  const std::uint64_t one = 1;
  // Fails only when the count would overflow, and then there is a notification already.
  [[maybe_unused]] const ssize_t written = write(fd_, &one, sizeof(one));
}

bool WakeUp::wait(Duration timeout) {
  return wait_with(-1, timeout);
}

bool WakeUp::wait_with(int other_fd, Duration timeout) {
  using std::chrono::seconds;
  const Duration left = std::max(timeout, Duration::zero());
  timespec wait_for = {};
  wait_for.tv_sec = static_cast<time_t>(std::chrono::duration_cast<seconds>(left).count());
  wait_for.tv_nsec = static_cast<long>((left % seconds(1)).count());
  pollfd fds[2] = {{.fd = fd_, .events = POLLIN, .revents = 0},
                   {.fd = other_fd, .events = POLLIN, .revents = 0}};
  if (ppoll(fds, 2, &wait_for, nullptr) <= 0) return false;
  std::uint64_t count = 0;
  return read(fd_, &count, sizeof(count)) == static_cast<ssize_t>(sizeof(count));
}

}  // namespace darkling
