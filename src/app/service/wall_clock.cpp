// SPDX-License-Identifier: Apache-2.0
#include "app/service/wall_clock.h"

#include "platform/clocks.h"

namespace darkling {

Duration WallClock::update() {
  return update(read_monotonic_clock(), read_epoch_clock());
}

Duration WallClock::update(MonotonicTime monotonic, EpochTime epoch) {
  const Duration offset = epoch.time_since_epoch() - monotonic.time_since_epoch();
  if (has_offset_ && std::chrono::abs(offset - offset_) > kStep) ++steps_;
  has_offset_ = true;
  offset_ = offset;
  return offset_;
}

}  // namespace darkling
