// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/service/health.h"
#include "base/time.h"
#include "drivers/frame_source.h"
#include "messages/status_t.hpp"

namespace darkling {

// What stays the same in every status of a replay.
struct ReplayFacts {
  std::string source;  // as the user named it, with what was injected
  std::string kernels;
  std::int64_t arena_bytes = 0;
  int width_px = 0;  // of the thumbnails
  int height_px = 0;
  Duration period = Duration::zero();  // between frames, as configured
};

// The service's status as it would have been, twice a second by the stamps of the frames: the same
// frames give the same bytes. What only a machine has is not known in it: latency, memory,
// exposure. Thread: one.
class ReplayStatus {
 public:
  explicit ReplayStatus(const ReplayFacts& facts);

  // The next pair, or what is known of a missing one.
  void add(const WaitResult& pair, const Estimate& estimate);

  // @return a status when half a second has passed since the last; the first comes with the first
  //         pair.
  [[nodiscard]] std::optional<status_t> take_due();
  // One more behind the last pair; nothing when there was none.
  [[nodiscard]] std::optional<status_t> take_last();

 private:
  [[nodiscard]] status_t take();

  const Duration period_;
  std::optional<Health> health_;  // from the first pair on
  FrameTime first_stamp_;
  FrameTime stamp_;  // of the last pair
  std::optional<FrameTime> status_stamp_;
  std::int64_t in_before_ = 0;  // when the last status was taken
  std::int64_t out_before_ = 0;
  status_t status_ = {};
};

}  // namespace darkling
