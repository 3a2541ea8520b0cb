// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "app/service/wish_messages.h"

namespace darkling {

// Hands out the wishes of a recording, each before the pair that it was obeyed before; where that
// pair does not come any more, before the next one there is.
class DueWishes {
 public:
  explicit DueWishes(std::vector<RecordedWish> wishes) : wishes_(std::move(wishes)) {}

  // Those that are due before the pair of this sequence and were not handed out yet. Valid as long
  // as this is.
  [[nodiscard]] std::span<const RecordedWish> take(std::int64_t sequence) {
    const std::size_t first = next_;
    while (next_ < wishes_.size() && wishes_[next_].sequence <= sequence) ++next_;
    return std::span(wishes_).subspan(first, next_ - first);
  }

 private:
  std::vector<RecordedWish> wishes_;  // in the order in which they were obeyed
  std::size_t next_ = 0;
};

}  // namespace darkling
