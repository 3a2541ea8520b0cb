// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <string>

#include "io/decimal_time.h"
#include "io/evaluate.h"

namespace darkling {

namespace {

constexpr std::int64_t kStampToleranceNs = 5'000'000;
constexpr std::size_t kFewestMatches = 3;  // for an alignment

const char* name_of(PoseKey key) {
  return key == PoseKey::kRow ? "rows without time stamps (KITTI)" : "time stamps (TUM, EuRoC)";
}

const char* name_of(PoseFrame frame) {
  return frame == PoseFrame::kLeft ? "left camera" : "body";
}

std::string describe_range(const Trajectory& trajectory) {
  if (trajectory.poses.empty()) return "nothing";
  const auto [first, last] =
      std::minmax_element(trajectory.poses.begin(), trajectory.poses.end(),
                          [](const TimedPose& a, const TimedPose& b) { return a.stamp < b.stamp; });
  if (trajectory.key == PoseKey::kRow) {
    return "rows " + std::to_string(to_ns(first->stamp)) + " to " +
           std::to_string(to_ns(last->stamp));
  }
  return seconds_text_from_ns(to_ns(first->stamp)) + " s to " +
         seconds_text_from_ns(to_ns(last->stamp)) + " s";
}

// The pose nearest to `stamp`, the earlier of two at the same distance.
// @pre `poses` is sorted by stamp and not empty.
const TimedPose& nearest_pose(const std::vector<TimedPose>& poses, FrameTime stamp) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), stamp,
                       [](const TimedPose& pose, FrameTime t) { return pose.stamp < t; });
  if (after == poses.begin()) return *after;
  const auto before = std::prev(after);
  if (after == poses.end()) return *before;
  return after->stamp - stamp < stamp - before->stamp ? *after : *before;
}

}  // namespace

Result<std::vector<PosePair>> match_poses(const Trajectory& truth, const Trajectory& estimate) {
  if (truth.key != estimate.key) {
    return failure(ExitCode::kBadInput, std::string("truth and estimate cannot be matched: the ") +
                                            "truth has " + name_of(truth.key) + ", the estimate " +
                                            name_of(estimate.key));
  }
  if (truth.frame != estimate.frame) {
    return failure(ExitCode::kBadInput, std::string("the truth is of the ") + name_of(truth.frame) +
                                            ", the estimate of the " + name_of(estimate.frame));
  }
  std::vector<TimedPose> sorted = truth.poses;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.stamp < b.stamp; });
  const std::int64_t tolerance = truth.key == PoseKey::kRow ? 0 : kStampToleranceNs;

  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < estimate.poses.size() && !sorted.empty(); ++i) {
    const TimedPose& pose = estimate.poses[i];
    const TimedPose& nearest = nearest_pose(sorted, pose.stamp);
    if (std::abs((nearest.stamp - pose.stamp).count()) > tolerance) continue;
    pairs.push_back({.truth = nearest.T_world_pose, .estimate = pose.T_world_pose, .index = i});
  }
  if (pairs.size() < kFewestMatches) {
    return failure(ExitCode::kBadInput,
                   "truth and estimate have " + std::to_string(pairs.size()) +
                       " poses in common, at least 3 are needed: the truth covers " +
                       describe_range(truth) + ", the estimate " + describe_range(estimate));
  }
  return pairs;
}

}  // namespace darkling
