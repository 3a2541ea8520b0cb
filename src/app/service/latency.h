// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/time.h"

namespace darkling {

// How late the estimates of one report were, from mid-exposure to publishing.
// Thread: one.
class Latency {
 public:
  void add(Duration late) {
    if (count_ < late_.size()) late_[count_++] = late;
    most_ = std::max(most_, late);
  }
  [[nodiscard]] bool is_empty() const { return count_ == 0; }
  // @pre it is not empty. Of the first 256 of a report.
  [[nodiscard]] Duration median() {
    auto* middle = late_.data() + count_ / 2;
    std::nth_element(late_.data(), middle, late_.data() + count_);
    return *middle;
  }
  [[nodiscard]] Duration most() const { return most_; }
  void clear() { *this = Latency(); }

 private:
  std::array<Duration, 256> late_ = {};
  std::size_t count_ = 0;
  Duration most_ = Duration::min();
};

}  // namespace darkling
