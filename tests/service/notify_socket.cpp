// SPDX-License-Identifier: Apache-2.0
#include "service/notify_socket.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace darkling::test {

using std::chrono::milliseconds;

NotifySocket::NotifySocket()
    : path_(folder_ / "notify"), fd_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path_.c_str(), sizeof(address.sun_path) - 1);
  // The interface of sockets: every address is handed over as a sockaddr.
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (fd_ < 0 || bind(fd_, generic, sizeof(address)) != 0) {
    throw std::runtime_error(path_ + ": cannot listen: " + std::strerror(errno));
  }
  thread_ = std::thread([this] { read(); });
}

NotifySocket::~NotifySocket() {
  is_stopping_ = true;
  thread_.join();
  close(fd_);
}

void NotifySocket::read() {
  std::array<char, 4096> text;
  while (!is_stopping_) {
    pollfd waiting = {.fd = fd_, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, /*timeout_ms=*/50) != 1) continue;
    const ssize_t size = recv(fd_, text.data(), text.size(), 0);
    if (size < 0) continue;
    const std::lock_guard lock(mutex_);
    heard_.emplace_back(text.data(), static_cast<std::size_t>(size));
    changed_.notify_all();
  }
}

std::optional<std::string> NotifySocket::wait_for(const std::string& start, milliseconds timeout) {
  std::unique_lock lock(mutex_);
  std::optional<std::string> found;
  changed_.wait_for(lock, timeout, [&] {
    while (next_ < heard_.size() && !found) {
      const std::string& message = heard_[next_++];
      if (message.starts_with(start)) found = message;
    }
    return found.has_value();
  });
  return found;
}

int NotifySocket::count(const std::string& start, milliseconds time) {
  const auto count_all = [&] {
    const std::lock_guard lock(mutex_);
    return std::count_if(heard_.begin(), heard_.end(),
                         [&](const std::string& message) { return message.starts_with(start); });
  };
  const auto before = count_all();
  std::this_thread::sleep_for(time);
  return static_cast<int>(count_all() - before);
}

}  // namespace darkling::test
