// SPDX-License-Identifier: Apache-2.0
#include "support/fake_v4l2.h"

#include <algorithm>
#include <cerrno>

namespace darkling::test {

std::vector<std::string> FakeV4l2::violations() const {
  std::vector<std::string> all = violations_;
  for (const auto& [path, device] : devices_) {
    all.insert(all.end(), device.violations.begin(), device.violations.end());
  }
  return all;
}

void FakeV4l2::pass(Duration time) {
  now_ += time;
  for (auto& [path, device] : devices_) device.advance(now_);
}

FakeV4l2Device* FakeV4l2::find(int descriptor) {
  const auto found = open_.find(descriptor);
  if (found != open_.end()) return found->second;
  violations_.emplace_back("a call on a descriptor that is not open");
  return nullptr;
}

int FakeV4l2::open(const char* path) {
  const auto found = devices_.find(path);
  if (found == devices_.end() || found->second.is_gone) return -ENOENT;
  if (found->second.open_error != 0) return -found->second.open_error;
  open_[next_descriptor_] = &found->second;
  return next_descriptor_++;
}

int FakeV4l2::close(int descriptor) {
  FakeV4l2Device* device = find(descriptor);
  if (device == nullptr) return -EBADF;
  device->close();
  open_.erase(descriptor);
  return 0;
}

int FakeV4l2::ioctl(int descriptor, unsigned long request, void* argument) {
  FakeV4l2Device* device = find(descriptor);
  return device == nullptr ? -EBADF : device->ioctl(request, argument, now_);
}

DeviceCalls::Mapped FakeV4l2::map(int descriptor, std::size_t bytes, std::int64_t offset) {
  FakeV4l2Device* device = find(descriptor);
  if (device == nullptr) return {.address = nullptr, .error = -EBADF};
  std::uint8_t* address = device->map(offset, bytes);
  if (address == nullptr) return {.address = nullptr, .error = -ENOMEM};
  maps_[address] = device;
  return {.address = address, .error = 0};
}

int FakeV4l2::unmap(void* address, std::size_t /*bytes*/) {
  const auto found = maps_.find(address);
  if (found == maps_.end()) {
    violations_.emplace_back("an address was unmapped that is not mapped");
    return -EINVAL;
  }
  found->second->unmap(address);
  maps_.erase(found);
  return 0;
}

int FakeV4l2::look(std::span<pollfd> wanted) {
  int ready = 0;
  for (pollfd& want : wanted) {
    want.revents = 0;
    if (want.fd < 0) continue;
    FakeV4l2Device* device = find(want.fd);
    constexpr int kAlways = POLLERR | POLLHUP;
    want.revents = device == nullptr
                       ? static_cast<short>(POLLNVAL)
                       : static_cast<short>(device->readiness() & (want.events | kAlways));
    ready += want.revents != 0 ? 1 : 0;
  }
  return ready;
}

// Even a call that need not wait takes its time, so that no loop runs for ever.
int FakeV4l2::poll(std::span<pollfd> wanted, Duration timeout) {
  if (on_poll) on_poll();
  pass(std::chrono::microseconds(1));
  const MonotonicTime deadline = now_ + timeout;
  while (true) {
    if (const int ready = look(wanted); ready > 0) return ready;
    MonotonicTime next = deadline;
    for (const auto& [path, device] : devices_) next = std::min(next, device.next_frame_at(now_));
    if (now_ >= deadline) return 0;
    pass(std::min(next, deadline) - now_);
  }
}

}  // namespace darkling::test
