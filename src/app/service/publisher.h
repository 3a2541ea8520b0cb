// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/time.h"
#include "messages/wire.h"

struct _lcm_t;  // NOLINT(bugprone-reserved-identifier): LCM's own name

namespace darkling {

// Sends messages over LCM, and goes on trying where there is no network.
// No heap call after the first message, as long as the network stays.
// Thread: one.
class Publisher {
 public:
  // @param url     as lcm_create() takes it.
  // @param prefix  put before the name of every channel.
  Publisher(const std::string& url, const std::string& prefix);

  // @return whether it was sent; else it is counted in failures().
  template <class Message>
  bool publish(std::string_view channel, const Message& message) {
    return send(channel, std::span(buffer_).first(encode_into(std::span(buffer_), message)));
  }

  // Opens the network when that is due: every 0.5 s at first, every 5 s at last.
  void open_when_due(MonotonicTime now);
  // The last message was sent.
  [[nodiscard]] bool is_working() const { return is_working_; }
  [[nodiscard]] std::int64_t failures() const { return failures_; }

 private:
  static constexpr std::size_t kMostBytes = 4096;  // of a message; none of ours comes near

  bool send(std::string_view channel, std::span<const std::byte> message);

  struct Closer {
    void operator()(_lcm_t* lcm) const;
  };
  std::unique_ptr<_lcm_t, Closer> lcm_;
  std::string url_;
  std::string prefix_;
  std::string channel_;  // with the prefix, of the message being sent
  std::array<std::byte, kMostBytes> buffer_ = {};
  MonotonicTime next_attempt_at_;
  Duration back_off_;
  bool is_working_ = false;
  std::int64_t failures_ = 0;
};

}  // namespace darkling
