// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "drivers/v4l2/device_calls.h"
#include "support/fake_v4l2_device.h"

namespace darkling::test {

// An operating system with cameras and a clock of its own, which moves only while somebody waits.
// It keeps account of what is open and mapped, and notes what no driver may do.
class FakeV4l2 final : public DeviceCalls {
 public:
  // The device at `path`, made on first use.
  FakeV4l2Device& device(const std::string& path) { return devices_[path]; }
  // Called at the start of every poll().
  std::function<void()> on_poll;

  [[nodiscard]] int open_count() const { return static_cast<int>(open_.size()); }
  [[nodiscard]] int map_count() const { return static_cast<int>(maps_.size()); }
  // Of all devices, and calls on descriptors or addresses that are none.
  [[nodiscard]] std::vector<std::string> violations() const;
  void pass(Duration time);

  int open(const char* path) override;
  int close(int descriptor) override;
  int ioctl(int descriptor, unsigned long request, void* argument) override;
  Mapped map(int descriptor, std::size_t bytes, std::int64_t offset) override;
  int unmap(void* address, std::size_t bytes) override;
  int poll(std::span<pollfd> wanted, Duration timeout) override;
  [[nodiscard]] MonotonicTime now() const override { return now_; }

 private:
  FakeV4l2Device* find(int descriptor);
  int look(std::span<pollfd> wanted);

  std::map<std::string, FakeV4l2Device> devices_;
  std::map<int, FakeV4l2Device*> open_;
  std::map<const void*, FakeV4l2Device*> maps_;
  std::vector<std::string> violations_;
  int next_descriptor_ = 3;
  MonotonicTime now_{std::chrono::milliseconds(999'990)};
};

}  // namespace darkling::test
