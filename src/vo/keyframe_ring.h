// SPDX-License-Identifier: Apache-2.0
// The keyframes of the way just driven: where a lost track may find itself again.
#pragma once

#include <span>

#include "base/arena.h"
#include "base/fixed_vector.h"
#include "geometry/se3.h"
#include "vo/covariance.h"
#include "vo/keyframe_template.h"
#include "vo/limits.h"
#include "vo/window.h"

namespace darkling {

// A keyframe as it was made, with some of its points.
struct RingKeyframe {
  // Tracks are numbered as they begin. The oldest is in World; a later one began at a pose that was
  // held while the vehicle moved on unseen, and is off by that way.
  int track = 0;
  Se3 T_world_key;
  PoseCovariance::Accumulated covariance;  // of T_world_key
  KeyframeTemplate points;
};

struct KeyframeRing {
  FixedVector<RingKeyframe, kRingKeyframes> slots;
  int count = 0;  // slots in use, in the order in which they were made

  [[nodiscard]] std::span<RingKeyframe> keyframes() {
    return {slots.data(), static_cast<std::size_t>(count)};
  }
  [[nodiscard]] std::span<const RingKeyframe> keyframes() const {
    return {slots.data(), static_cast<std::size_t>(count)};
  }
  [[nodiscard]] RingKeyframe& newest() { return slots[static_cast<std::size_t>(count - 1)]; }
};

// @param ring  new.
void allocate_ring(int level_count, int points_per_level, Arena& arena, KeyframeRing& ring);

// Appends a keyframe, with points evenly taken from all of each level. When the ring is full the
// oldest of those that are not of the oldest track leaves: what is off must not push out what leads
// back to World. Only where there is none, or a later track still has less than half of the ring,
// the oldest of the oldest track does.
// Cost: a copy of 40 KiB.
void add_to_ring(int track, const Se3& T_world_key, const PoseCovariance::Accumulated& covariance,
                 const KeyframeTemplate& points, KeyframeRing& ring);

// Gives the ring's newest keyframes the poses that a refinement of the window found for them.
// @pre those of the window are the last that were added, in the same order.
void follow_window(const Window& window, KeyframeRing& ring);

// A track turned out to be off: its keyframes move by T_old_track, the pose of its World in that of
// `old_track`, and belong to that from now on.
void join_tracks(int track, int old_track, const Se3& T_old_track, KeyframeRing& ring);

}  // namespace darkling
