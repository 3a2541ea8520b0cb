// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/time.h"

namespace darkling {

// Lets one thread sleep until another has something for it. Notifications that come while nobody
// waits are kept, as one.
// Thread: notify() from any, also from a signal handler; wait() from one.
class WakeUp {
 public:
  WakeUp();
  ~WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;

  void notify();
  // @return whether it was notified, since the last time it said so.
  bool wait(Duration timeout);
  // The same, and wakes up for `other_fd` too, when that is not negative.
  bool wait_with(int other_fd, Duration timeout);

 private:
  int fd_;
};

}  // namespace darkling
