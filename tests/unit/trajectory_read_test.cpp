// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/trajectory.h"
#include "support/temporary_folder.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;

constexpr const char* kIdentityRow = "1 0 0 0 0 1 0 0 0 0 1 0\n";

Result<Trajectory> read_content(const std::string& content) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "trajectory", content);
  return read_trajectory(folder / "trajectory");
}

void expect_refused(const std::string& content, const std::string& message_part) {
  const auto read = read_content(content);
  ASSERT_FALSE(read) << content;
  EXPECT_EQ(read.error().code, ExitCode::kBadInput);
  EXPECT_THAT(read.error().message, HasSubstr(message_part));
}

TEST(ReadTrajectory, ReadsEurocGroundTruth) {
  const auto read = read_content(
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z [], v_RS_R_x [m s^-1]\r\n"
      "1403636580838555648,4.688319,-1.786938,0.783338,0.5,-0.5,0.5,-0.5,0.1\r\n");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->poses.size(), 1u);
  EXPECT_EQ(read->key, PoseKey::kStamp);
  EXPECT_EQ(read->frame, PoseFrame::kBody);
  EXPECT_EQ(to_ns(read->poses[0].stamp), 1403636580838555648);
  const Eigen::Affine3d& T = read->poses[0].T_world_pose;
  EXPECT_EQ(T.translation(), Vector3(4.688319, -1.786938, 0.783338));
  const Eigen::Quaterniond q(0.5, -0.5, 0.5, -0.5);
  EXPECT_TRUE(T.linear().isApprox(q.toRotationMatrix(), 1e-15));
}

TEST(ReadTrajectory, ReadsTheScalarOfATumQuaternionLast) {
  const auto read = read_content("0.5 1 2 3 0 0 0.6 0.8\n");
  ASSERT_TRUE(read) << read.error().message;
  const Matrix3 R = read->poses[0].T_world_pose.linear();
  const Vector3 x_turned(0.28, 0.96, 0);  // cos and sin of 2·atan(0.6 / 0.8)
  EXPECT_TRUE(R.col(0).isApprox(x_turned, 1e-15));
}

TEST(ReadTrajectory, KeepsRowsOfSevenDigitsAsTheyAre) {
  const auto read = read_content(
      "9.999995e-01 7.196824e-04 -6.870876e-04 -1.4e-02 -7.197717e-04 9.999997e-01 -1.295633e-04 "
      "-2.8e-02 6.869946e-04 1.300585e-04 9.999998e-01 1.198998\n");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->poses[0].T_world_pose.linear()(0, 0), 9.999995e-01);
  EXPECT_EQ(read->poses[0].T_world_pose.linear()(2, 1), 1.300585e-04);
}

TEST(ReadTrajectory, SkipsCommentsAndBlankLines) {
  const auto read = read_content(std::string("# a\n\n") + kIdentityRow + "  \n" + kIdentityRow);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->poses.size(), 2u);
}

TEST(ReadTrajectory, NamesTheLineAndColumnOfWhatIsNoNumber) {
  expect_refused(std::string(kIdentityRow) + "1 0 0 0 0 1 0 x 0 0 1 0\n",
                 "trajectory:2: column 8 is 'x'");
  expect_refused("1 0 0 nan 0 1 0 0 0 0 1 0\n", "column 4 is 'nan'");
  expect_refused("today 1 2 3 0 0 0 1\n", "column 1 is 'today', not a time in seconds");
  expect_refused("1.5,1,2,3,1,0,0,0\n", "column 1 is '1.5', not a time in nanoseconds");
}

TEST(ReadTrajectory, NamesTheLineWhoseColumnsDiffer) {
  expect_refused(std::string("# KITTI\n") + kIdentityRow + "0 1 2 3 0 0 0 1\n",
                 "trajectory:3: 8 columns where the rows before have 12");
  expect_refused(std::string(kIdentityRow) + "1 0 0 0 0 1", "trajectory:2: 6 columns");
  expect_refused("1 2 3\n", "trajectory:1: 3 columns; a trajectory has 12");
}

TEST(ReadTrajectory, RefusesWhatIsNoRigidMotion) {
  expect_refused("2 0 0 0 0 1 0 0 0 0 1 0\n", "not a rotation");
  expect_refused("1 0 0 0 0 1 0 0 0 0 -1 0\n", "not a rotation");  // a mirror
  expect_refused("0 1 2 3 0 0 0 0\n", "the quaternion has length 0");
}

TEST(ReadTrajectory, RefusesAFileWithoutPoses) {
  expect_refused("# nothing\n", "holds no poses");
}

TEST(ReadTrajectory, SaysWhichFileIsAbsent) {
  const test::TemporaryFolder folder;
  const auto read = read_trajectory(folder / "absent.txt");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ExitCode::kNoInput);
  EXPECT_THAT(read.error().message, HasSubstr("absent.txt: No such file"));
}

TEST(ReadTrajectory, RefusesAFolder) {
  const test::TemporaryFolder folder;
  const auto read = read_trajectory(folder.path());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ExitCode::kNoInput);
}

}  // namespace
}  // namespace darkling
