// SPDX-License-Identifier: Apache-2.0
#include "support/golden_trajectory.h"

#include <cmath>

#include "support/temporary_folder.h"

namespace darkling::test {
namespace {

Trajectory three_poses() {
  Trajectory trajectory;
  for (int i = 0; i < 3; ++i) {
    TimedPose pose;
    pose.T_world_pose.translation() = Eigen::Vector3d(i, 0.0, 0.0);
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

TEST(GoldenTrajectory, AgreesWithItself) {
  EXPECT_TRUE(agree(three_poses(), three_poses()));
}

TEST(GoldenTrajectory, NoticesTwoMicrometres) {
  Trajectory moved = three_poses();
  moved.poses[1].T_world_pose.translation().y() += 2e-6;
  EXPECT_FALSE(agree(three_poses(), moved));
}

TEST(GoldenTrajectory, NoticesTwoMicroradians) {
  Trajectory turned = three_poses();
  turned.poses[2].T_world_pose.rotate(Eigen::AngleAxisd(2e-6, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(agree(three_poses(), turned));
  turned.poses[2].T_world_pose.rotate(Eigen::AngleAxisd(-1.9e-6, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(agree(three_poses(), turned));
}

TEST(GoldenTrajectory, NoticesAMissingPoseAndNumbersThatAreNone) {
  Trajectory shorter = three_poses();
  shorter.poses.pop_back();
  EXPECT_FALSE(agree(three_poses(), shorter));
  Trajectory broken = three_poses();
  broken.poses[0].T_world_pose.translation().x() = std::nan("");
  EXPECT_FALSE(agree(three_poses(), broken));
}

TEST(GoldenTrajectory, NeedsItsFile) {
  TemporaryFolder folder;
  write_text(folder / "found.txt", shortened(three_poses()));
  if (is_update_wanted()) GTEST_SKIP() << "files are being written";
  EXPECT_FALSE(is_golden("no_such_golden", folder / "found.txt"));
  EXPECT_FALSE(is_golden("corridor", folder / "found.txt"));
}

}  // namespace
}  // namespace darkling::test
