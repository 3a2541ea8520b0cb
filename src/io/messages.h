// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/time.h"
#include "messages/bot_core/pose_t.hpp"
#include "messages/pose_t.hpp"
#include "messages/update_t.hpp"
#include "vo/estimate.h"

namespace darkling {

// The two messages of every frame, filled anew from each Estimate in memory of their own.
// Thread: one.
class EstimateMessages {
 public:
  // @param estimate     the next; each is told once, lost ones too.
  // @param epoch_offset CLOCK_REALTIME minus the clock that stamps the frames, at this moment. A
  //                     step of the wall clock shows in `utime` and never in a velocity.
  void fill(const Estimate& estimate, Duration epoch_offset);

  [[nodiscard]] const update_t& update() const { return update_; }
  [[nodiscard]] const pose_t& pose() const { return pose_; }
  // The same as other software knows it.
  [[nodiscard]] bot_core::pose_t bot_core_pose() const;

 private:
  update_t update_ = {};
  pose_t pose_ = {};
  std::optional<FrameTime> previous_stamp_;
};

}  // namespace darkling
