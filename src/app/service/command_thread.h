// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "app/service/command_ring.h"

namespace darkling {

// Listens to VO_COMMAND and VO_HINT. On a thread of its own: LCM may take ten seconds to find out
// that it cannot listen.
class CommandThread {
 public:
  struct Links {
    WishRing& wishes;
    // Called for command_t::COMMAND_* that are not for the odometry. Thread: this one.
    std::function<void(std::int8_t command)> on_command;
  };
  CommandThread(Links links, const std::string& lcm_url, const std::string& channel_prefix);
  ~CommandThread();
  CommandThread(const CommandThread&) = delete;
  CommandThread& operator=(const CommandThread&) = delete;

  // What was heard and was no message of ours, or one that makes no sense. Thread: any.
  [[nodiscard]] std::int64_t malformed() const { return malformed_; }

 private:
  class Listener;
  void serve();

  Links links_;
  std::string lcm_url_;
  std::string channel_prefix_;
  std::atomic<std::int64_t> malformed_ = 0;
  std::atomic<bool> is_stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace darkling
