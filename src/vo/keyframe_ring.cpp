// SPDX-License-Identifier: Apache-2.0
#include "vo/keyframe_ring.h"

#include <algorithm>

#include "base/check.h"
#include "vo/copy_points.h"

namespace darkling {

namespace {

constexpr int kArrays = 6;  // of floats that template points have

int capacity_of_level(int points_per_level, int level) {
  return std::min(points_on_level(points_per_level, level),
                  level == 0 ? kRingPoints : kRingCoarsePoints);
}

// The next part of a block; nothing of nothing.
template <class T>
T* take(T*& next, int count) {
  T* first = next;
  if (next != nullptr) next += count;
  return first;
}

TemplateLevel take_level(int capacity, float*& arrays, PlanePatch*& patches) {
  const int lanes = round_up_to_lanes(capacity);
  TemplateLevel level;
  level.capacity = capacity;
  TemplatePoints& points = level.points;
  for (float** array :
       {&points.x, &points.y, &points.inverse_depth_focal, &points.Sxx, &points.Sxy, &points.Syy}) {
    *array = take(arrays, lanes);
  }
  points.patches = take(patches, lanes);
  return level;
}

void copy_level(const TemplateLevel& from, TemplateLevel& to) {
  copy_points(from.points, to.capacity, to.points);
  to.mean_inverse_depth_focal = from.mean_inverse_depth_focal;
}

// Which keyframe leaves a full ring to one of `track`.
RingKeyframe* leaving(std::span<RingKeyframe> keyframes, int track) {
  const auto is_older = [](const RingKeyframe& a, const RingKeyframe& b) {
    return a.track < b.track;
  };
  const int oldest = std::min_element(keyframes.begin(), keyframes.end(), is_older)->track;
  const auto is_of_oldest = [oldest](const RingKeyframe& key) { return key.track == oldest; };
  const auto share = std::count_if(keyframes.begin(), keyframes.end(), is_of_oldest);
  const auto other = std::find_if_not(keyframes.begin(), keyframes.end(), is_of_oldest);
  const bool has_too_many = track != oldest && 2 * share > std::ssize(keyframes);
  if (other != keyframes.end() && !has_too_many) return &*other;
  return &*std::find_if(keyframes.begin(), keyframes.end(), is_of_oldest);
}

}  // namespace

// One block for all: an arena has names for 256 buffers only.
void allocate_ring(int level_count, int points_per_level, Arena& arena, KeyframeRing& ring) {
  std::size_t lanes = 0;
  for (int l = 0; l < level_count; ++l) {
    lanes += static_cast<std::size_t>(round_up_to_lanes(capacity_of_level(points_per_level, l)));
  }
  lanes *= kRingKeyframes;
  float* arrays = arena.allocate<float>(kArrays * lanes, "ring points").data();
  PlanePatch* patches = arena.allocate<PlanePatch>(lanes, "ring patches").data();
  for (int i = 0; i < kRingKeyframes; ++i) {
    RingKeyframe key;
    for (int l = 0; l < level_count; ++l) {
      const int capacity = capacity_of_level(points_per_level, l);
      CHECK(key.points.levels.push_back(take_level(capacity, arrays, patches)),
            "more levels than kMaxLevels");
    }
    CHECK(ring.slots.push_back(key), "the ring has room for kRingKeyframes");
  }
}

void add_to_ring(int track, const Se3& T_world_key, const PoseCovariance::Accumulated& covariance,
                 const KeyframeTemplate& points, KeyframeRing& ring) {
  if (ring.count == kRingKeyframes) {
    RingKeyframe* const first = leaving(ring.keyframes(), track);
    std::rotate(first, first + 1, ring.slots.end());
    --ring.count;
  }
  ++ring.count;
  RingKeyframe& key = ring.newest();
  key.track = track;
  key.T_world_key = T_world_key;
  key.covariance = covariance;
  for (std::size_t l = 0; l < points.levels.size(); ++l) {
    copy_level(points.levels[l], key.points.levels[l]);
  }
}

void follow_window(const Window& window, KeyframeRing& ring) {
  CHECK(window.count <= ring.count, "the window's keyframes are in the ring");
  for (int i = 0; i < window.count; ++i) {
    ring.slots[static_cast<std::size_t>(ring.count - window.count + i)].T_world_key =
        window.slots[static_cast<std::size_t>(i)].T_world_key;
  }
}

void join_tracks(int track, int old_track, const Se3& T_old_track, KeyframeRing& ring) {
  for (RingKeyframe& key : ring.keyframes()) {
    if (key.track != track) continue;
    key.track = old_track;
    key.T_world_key = T_old_track * key.T_world_key;
  }
}

}  // namespace darkling
