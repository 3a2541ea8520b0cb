// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "support/temporary_folder.h"

namespace darkling::test {

// What systemd's end of a service's notifications hears. A thread reads them as they come: a
// service whose notifications nobody reads would wait.
class NotifySocket {
 public:
  NotifySocket();
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  // The next message, from where the last call stopped, that begins with `start`.
  [[nodiscard]] std::optional<std::string> wait_for(const std::string& start,
                                                    std::chrono::milliseconds timeout);
  // How many come that begin so, within the time from now on.
  [[nodiscard]] int count(const std::string& start, std::chrono::milliseconds time);

 private:
  void read();

  TemporaryFolder folder_;
  std::string path_;
  int fd_ = -1;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<std::string> heard_;
  std::size_t next_ = 0;
  std::atomic<bool> is_stopping_ = false;
  std::thread thread_;
};

}  // namespace darkling::test
