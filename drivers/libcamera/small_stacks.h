// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <pthread.h>

namespace darkling {

// While it stands, threads that do not say otherwise get a stack of 1 MiB. Where all memory is
// locked, each of a library's threads would else cost the 8 MiB that are usual, used or not.
class SmallStacks {
 public:
  SmallStacks() {
    is_read_ = pthread_getattr_default_np(&before_) == 0;
    if (!is_read_) return;
    pthread_attr_t small = before_;
    is_set_ = pthread_attr_setstacksize(&small, kStack_bytes) == 0 &&
              pthread_setattr_default_np(&small) == 0;
  }
  ~SmallStacks() {
    if (is_set_) pthread_setattr_default_np(&before_);
    if (is_read_) pthread_attr_destroy(&before_);
  }
  SmallStacks(const SmallStacks&) = delete;
  SmallStacks& operator=(const SmallStacks&) = delete;

 private:
  static constexpr std::size_t kStack_bytes = std::size_t{1} << 20;

  pthread_attr_t before_ = {};
  bool is_read_ = false;
  bool is_set_ = false;
};

}  // namespace darkling
