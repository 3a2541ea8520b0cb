// SPDX-License-Identifier: Apache-2.0
#include <clocale>

#include <gtest/gtest.h>

#include "io/trajectory.h"
#include "support/random.h"
#include "support/random_walk.h"
#include "support/temporary_folder.h"

namespace darkling {
namespace {

constexpr const char* kOne = "1.0000000000000000e+00";
constexpr const char* kZero = "0.0000000000000000e+00";

TEST(FormatKittiRow, WritesTheIdentityAsOnesAndZeros) {
  std::string expected;
  for (int i = 0; i < 12; ++i) {
    expected += std::string(i % 5 == 0 ? kOne : kZero) + (i < 11 ? " " : "\n");
  }
  EXPECT_EQ(format_kitti_row(Se3()), expected);
}

TEST(FormatKittiRow, WritesNegativeZeroAsZero) {
  EXPECT_EQ(format_kitti_row(Se3(Eigen::Quaterniond::Identity(), {-0.0, -0.0, -0.0})),
            format_kitti_row(Se3()));
}

TEST(FormatKittiRow, DoesNotFollowTheLocale) {
  const Se3 T(so3_exp({0.1, 0.2, 0.3}), {1.5, -2.5, 3.5});
  const std::string before = format_kitti_row(T);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) std::setlocale(LC_ALL, "C.UTF-8");
  const std::string during = format_kitti_row(T);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(before, during);
}

TEST(FormatTumRow, PutsTheScalarLastAndMakesItPositive) {
  const Se3 half_turn_and_more(Eigen::Quaterniond(-0.5, 0.5, 0.5, 0.5), {1, 2, 3});
  const std::string row = format_tum_row(frame_time_from_ns(1500000000), half_turn_and_more);
  EXPECT_EQ(row,
            "1.500000000 1.0000000000000000e+00 2.0000000000000000e+00 3.0000000000000000e+00 "
            "-5.0000000000000000e-01 -5.0000000000000000e-01 -5.0000000000000000e-01 "
            "5.0000000000000000e-01\n");
}

TEST(Trajectory, ReadsBackWhatWasWrittenAsKitti) {
  const auto walk = test::random_walk(7, 40, 1.0, 0.1);
  std::string content;
  for (const Se3& T : walk.estimate) content += format_kitti_row(T);
  const test::TemporaryFolder folder;
  test::write_text(folder / "a.txt", content);
  const auto read = read_trajectory(folder / "a.txt");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->poses.size(), walk.estimate.size());
  EXPECT_EQ(read->key, PoseKey::kRow);
  EXPECT_EQ(read->frame, PoseFrame::kLeft);
  for (std::size_t i = 0; i < read->poses.size(); ++i) {
    EXPECT_EQ(to_ns(read->poses[i].stamp), static_cast<std::int64_t>(i));
    EXPECT_EQ(read->poses[i].T_world_pose.matrix(), walk.estimate[i].matrix());
  }
}

TEST(Trajectory, ReadsBackWhatWasWrittenAsTum) {
  const auto walk = test::random_walk(8, 40, 1.0, 0.1);
  constexpr std::int64_t kStart_ns = 1403636584763555584;
  constexpr std::int64_t kPeriod_ns = 49999872;
  std::string content = "# stamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < walk.estimate.size(); ++i) {
    const auto stamp = frame_time_from_ns(kStart_ns + kPeriod_ns * static_cast<std::int64_t>(i));
    content += format_tum_row(stamp, walk.estimate[i]);
  }
  const test::TemporaryFolder folder;
  test::write_text(folder / "a.tum", content);
  const auto read = read_trajectory(folder / "a.tum");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->poses.size(), walk.estimate.size());
  EXPECT_EQ(read->key, PoseKey::kStamp);
  EXPECT_EQ(read->frame, PoseFrame::kBody);
  for (std::size_t i = 0; i < read->poses.size(); ++i) {
    const auto k = static_cast<std::int64_t>(i);
    EXPECT_EQ(to_ns(read->poses[i].stamp), kStart_ns + kPeriod_ns * k);
    EXPECT_TRUE(read->poses[i].T_world_pose.matrix().isApprox(walk.estimate[i].matrix(), 1e-15));
  }
}

}  // namespace
}  // namespace darkling
