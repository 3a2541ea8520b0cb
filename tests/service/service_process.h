// SPDX-License-Identifier: Apache-2.0
// `darklingd` as built, started as systemd would.
#pragma once

#include <string>
#include <vector>

#include "service/listener.h"
#include "service/notify_socket.h"
#include "service/patience.h"
#include "support/run_program.h"

namespace darkling::test {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A scene that is rendered within a second and then driven to and fro for ever.
inline constexpr const char* kSmallScene = "camera=synthetic:corridor,frames=6,width=96,seed=3";

class ServiceProcess {
 public:
  // @param settings  key=value, besides the small scene and a network of its own.
  explicit ServiceProcess(std::vector<std::string> settings = {},
                          const std::vector<std::string>& more_words = {},
                          milliseconds watchdog = seconds(1));

  [[nodiscard]] NotifySocket& notifications() { return notifications_; }
  [[nodiscard]] Listener& listener() { return listener_; }
  void send_signal(int signal_number) const { program_.send_signal(signal_number); }
  [[nodiscard]] ProgramResult wait() { return program_.wait(); }
  // @return the first status after now that has this state, or nothing in time.
  [[nodiscard]] bool reaches(std::int8_t state, milliseconds timeout = kPatience) const;

 private:
  std::string url_ = new_lcm_url();
  NotifySocket notifications_;
  Listener listener_;
  RunningProgram program_;
};

}  // namespace darkling::test
