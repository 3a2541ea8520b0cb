// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/evaluate.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;

// Poses whose x says which they are.
Trajectory stamped(const std::vector<std::int64_t>& stamps_ms) {
  Trajectory trajectory{.frame = PoseFrame::kBody, .key = PoseKey::kStamp, .poses = {}};
  for (std::size_t i = 0; i < stamps_ms.size(); ++i) {
    TimedPose pose{.stamp = frame_time_from_ns(stamps_ms[i] * 1'000'000)};
    pose.T_world_pose.translation().x() = static_cast<double>(i);
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

std::vector<std::pair<int, int>> matched(const Trajectory& truth, const Trajectory& estimate) {
  const auto pairs = match_poses(truth, estimate);
  EXPECT_TRUE(pairs) << pairs.error().message;
  std::vector<std::pair<int, int>> indices;
  if (!pairs) return indices;
  for (const PosePair& pair : *pairs) {
    indices.emplace_back(static_cast<int>(pair.truth.translation().x()),
                         static_cast<int>(pair.estimate.translation().x()));
  }
  return indices;
}

using Indices = std::vector<std::pair<int, int>>;

TEST(MatchPoses, TakesTheNearestTruth) {
  const Trajectory truth = stamped({0, 10, 20, 30, 40});
  EXPECT_EQ(matched(truth, stamped({1, 14, 16, 39})), (Indices{{0, 0}, {1, 1}, {2, 2}, {4, 3}}));
}

TEST(MatchPoses, TakesTheEarlierOfTwoAsNear) {
  EXPECT_EQ(matched(stamped({0, 10, 20}), stamped({5, 15, 20})), (Indices{{0, 0}, {1, 1}, {2, 2}}));
}

TEST(MatchPoses, LeavesOutWhatIsMoreThanFiveMillisecondsAway) {
  EXPECT_EQ(matched(stamped({0, 100, 200, 300}), stamped({0, 105, 206, 295, 306})),
            (Indices{{0, 0}, {1, 1}, {3, 3}}));
}

TEST(MatchPoses, DoesNotNeedTheTruthInOrder) {
  EXPECT_EQ(matched(stamped({20, 0, 10}), stamped({0, 10, 20})), (Indices{{1, 0}, {2, 1}, {0, 2}}));
}

TEST(MatchPoses, MatchesRowsByNumberOnly) {
  Trajectory truth = stamped({});
  Trajectory estimate = stamped({});
  truth.key = estimate.key = PoseKey::kRow;
  for (const std::int64_t row : {0, 1, 2, 3, 4, 5}) {
    truth.poses.push_back({.stamp = frame_time_from_ns(row)});
    truth.poses.back().T_world_pose.translation().x() = static_cast<double>(row);
  }
  for (const std::int64_t row : {1, 3, 5, 7}) {
    estimate.poses.push_back({.stamp = frame_time_from_ns(row)});
    estimate.poses.back().T_world_pose.translation().x() = static_cast<double>(row);
  }
  EXPECT_EQ(matched(truth, estimate), (Indices{{1, 1}, {3, 3}, {5, 5}}));
}

TEST(MatchPoses, SaysBothRangesWhenTheyDoNotOverlap) {
  const auto pairs = match_poses(stamped({0, 10, 20}), stamped({1000, 1010, 1020}));
  ASSERT_FALSE(pairs);
  EXPECT_EQ(pairs.error().code, ExitCode::kBadInput);
  EXPECT_THAT(pairs.error().message, HasSubstr("0.000000000 s to 0.020000000 s"));
  EXPECT_THAT(pairs.error().message, HasSubstr("1.000000000 s to 1.020000000 s"));
}

TEST(MatchPoses, RefusesToMixRowsAndStamps) {
  Trajectory rows = stamped({0, 10, 20});
  rows.key = PoseKey::kRow;
  const auto pairs = match_poses(rows, stamped({0, 10, 20}));
  ASSERT_FALSE(pairs);
  EXPECT_EQ(pairs.error().code, ExitCode::kBadInput);
  EXPECT_THAT(pairs.error().message, HasSubstr("the truth has rows without time stamps (KITTI)"));
}

TEST(MatchPoses, RefusesToMixLeftAndBody) {
  Trajectory left = stamped({0, 10, 20});
  left.frame = PoseFrame::kLeft;
  EXPECT_FALSE(match_poses(left, stamped({0, 10, 20})));
}

TEST(MatchPoses, RefusesTwoPosesInCommon) {
  EXPECT_FALSE(match_poses(stamped({0, 10, 20}), stamped({0, 10})));
}

}  // namespace
}  // namespace darkling
