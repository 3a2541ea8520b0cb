// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "app/top/heard.h"
#include "base/time.h"

struct _lcm_t;           // NOLINT(bugprone-reserved-identifier): LCM's own name
struct _lcm_recv_buf_t;  // NOLINT(bugprone-reserved-identifier)

namespace darkling {

// Hears a service over LCM, and goes on trying where there is no network.
// Thread: one.
class Listener {
 public:
  // @param url     as lcm_create() takes it.
  // @param prefix  of the service's channels.
  Listener(const std::string& url, const std::string& prefix);

  // Takes what comes until `until`, or until a signal arrives; with no network, sleeps.
  void listen(MonotonicTime until);
  [[nodiscard]] const Heard& heard() const { return heard_; }

 private:
  void open_when_due(MonotonicTime now);
  static void on_status(const _lcm_recv_buf_t* received, const char* channel, void* user);
  static void on_pose(const _lcm_recv_buf_t* received, const char* channel, void* user);
  static void on_update(const _lcm_recv_buf_t* received, const char* channel, void* user);

  struct Closer {
    void operator()(_lcm_t* lcm) const;
  };
  std::string url_;
  std::string prefix_;
  std::string status_channel_;
  MonotonicTime next_attempt_at_;
  Heard heard_;
  std::unique_ptr<_lcm_t, Closer> lcm_;  // last: it calls back
};

}  // namespace darkling
