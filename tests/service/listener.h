// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "messages/pose_t.hpp"
#include "messages/status_t.hpp"
#include "messages/update_t.hpp"

namespace darkling::test {

// A network of its own for each test: no other test speaks there.
[[nodiscard]] std::string new_lcm_url();

// What a receiver hears of a service.
struct Heard {
  std::vector<update_t> updates;
  std::vector<pose_t> poses;
  std::vector<status_t> statuses;
};

// Listens over LCM on a thread of its own, and may speak.
class Listener {
 public:
  // Throws when there is no network.
  explicit Listener(const std::string& url, const std::string& prefix = "");
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] Heard heard() const;
  // @return whether `is_so` of what was heard became true in time.
  [[nodiscard]] bool wait_until(const std::function<bool(const Heard&)>& is_so,
                                std::chrono::milliseconds timeout) const;
  void send(const std::string& channel, const void* bytes, std::size_t size);
  // @param command  one of command_t::COMMAND_*.
  void send_command(std::int8_t command);
  // That nothing moved in the last 50 ms.
  void send_hint();

 private:
  struct Network;
  std::unique_ptr<Network> network_;
};

}  // namespace darkling::test
