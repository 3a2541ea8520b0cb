// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drivers/frame_source.h"
#include "vo/odometry.h"

namespace darkling {

// Tracks the pair, or skips it for its fault.
// @pre pair.status is kFrame or kBadFrame.
[[nodiscard]] inline Estimate follow_pair(Odometry& odometry, const WaitResult& pair) {
  if (pair.status == WaitStatus::kFrame) return odometry.track(pair.lease.frame());
  const bool is_unpaired = pair.fault == FrameFault::kUnpaired;
  return odometry.skip(pair.sequence, pair.stamp, is_unpaired ? kReasonUnsynced : kReasonDropped);
}

}  // namespace darkling
