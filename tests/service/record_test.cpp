// SPDX-License-Identifier: Apache-2.0
// What the service records, and what a replay makes of it.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/framelog/frame_log.h"
#include "drivers/framelog/framelog_source.h"
#include "kernels/kernel_table.h"
#include "messages/command_t.hpp"
#include "platform/clocks.h"
#include "platform/cpu_features.h"
#include "service/service_process.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::Heard;
using test::kPatience;
using test::seconds;
using test::ServiceProcess;
using ::testing::HasSubstr;

std::vector<std::string> logs_in(const std::string& folder, const std::string& start) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(start)) paths.push_back(entry.path());
  }
  return paths;
}

// T_world_body of every frame of a log, by its sequence number, as a replay gives it.
std::map<std::int64_t, Se3> replay(const std::string& path) {
  auto log = open_frame_log(path);
  EXPECT_TRUE(log) << log.error().message;
  EXPECT_EQ(describe_damage(*log), "");
  const auto kernels = select_kernels("auto", detect_cpu_features());
  auto odometry = Odometry::create({.width_px = 96}, log->rig, *kernels, read_monotonic_clock);
  EXPECT_TRUE(odometry);
  FramelogSource source(std::move(log->events), std::move(log->rows));
  EXPECT_TRUE(source.start());
  std::map<std::int64_t, Se3> poses;
  for (;;) {
    const WaitResult next = source.wait_next(std::chrono::seconds(1));
    if (next.status == WaitStatus::kEndOfSource) break;
    const Estimate estimate = next.status == WaitStatus::kFrame
                                  ? (*odometry)->track(next.lease.frame())
                                  : (*odometry)->skip(next.sequence, next.stamp);
    poses.emplace(estimate.sequence, estimate.T_world_body);
  }
  return poses;
}

TEST(Recording, ReplaysToTheSameBytesThatWerePublished) {
  const test::TemporaryFolder folder;
  ServiceProcess service({"record_to=" + folder.path(), "record=true"});
  ASSERT_TRUE(service.listener().wait_until(
      [](const Heard& heard) { return heard.poses.size() >= 60; }, kPatience));
  service.send_signal(SIGTERM);
  ASSERT_EQ(service.wait().status, 0);
  const std::vector<std::string> logs = logs_in(folder.path(), "darkling-");
  ASSERT_EQ(logs.size(), 1U);
  const std::map<std::int64_t, Se3> replayed = replay(logs.front());
  const Heard heard = service.listener().heard();
  ASSERT_EQ(heard.statuses.back().record_drops, 0);
  for (const pose_t& published : heard.poses) {
    ASSERT_TRUE(replayed.contains(published.seq)) << published.seq;
    const Se3& pose = replayed.at(published.seq);
    const Vector3 t(published.translation[0], published.translation[1], published.translation[2]);
    EXPECT_EQ(pose.translation(), t) << published.seq;
    EXPECT_EQ(pose.rotation().w(), published.rotation[0]) << published.seq;
    EXPECT_EQ(pose.rotation().z(), published.rotation[3]) << published.seq;
  }
}

TEST(Recording, StopsOnAFullDiskAndTheServiceGoesOn) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const test::TemporaryFolder folder;
  // One megabyte is full after some fifty pairs of 96x72 pixels.
  ServiceProcess service(
      {"record_to=" + folder.path(), "record=true", "record_limit_mb=1", "rate_hz=100"});
  ASSERT_TRUE(service.listener().wait_until(
      [](const Heard& heard) {
        return !heard.statuses.empty() && heard.statuses.back().recorded_frames > 0 &&
               heard.statuses.back().is_recording == 0;
      },
      kPatience));
  EXPECT_TRUE(service.reaches(status_t::STATE_TRACKING));
  service.send_signal(SIGTERM);
  const auto run = service.wait();
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("recording=failed"));
  const std::vector<std::string> logs = logs_in(folder.path(), "darkling-");
  ASSERT_EQ(logs.size(), 1U);
  EXPECT_GT(replay(logs.front()).size(), 20U);
}

TEST(Recording, SaysSoWhenTheFolderIsNotThere) {
  ServiceProcess service({"record_to=/no/such/folder", "record=true"});
  EXPECT_TRUE(service.reaches(status_t::STATE_TRACKING));
  service.send_signal(SIGTERM);
  EXPECT_THAT(service.wait().err, HasSubstr("recording=failed error=\"/no/such/folder/"));
}

TEST(BlackBox, IsWrittenWhenAsked) {
  const test::TemporaryFolder folder;
  ServiceProcess service({"record_to=" + folder.path(), "black_box_s=1"});
  ASSERT_TRUE(service.listener().wait_until(
      [](const Heard& heard) { return heard.poses.size() >= 30; }, kPatience));
  for (int i = 0; i < 50 && logs_in(folder.path(), "blackbox-").empty(); ++i) {
    service.listener().send_command(command_t::COMMAND_WRITE_BLACK_BOX);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  service.send_signal(SIGTERM);
  ASSERT_EQ(service.wait().status, 0);
  const std::vector<std::string> logs = logs_in(folder.path(), "blackbox-");
  ASSERT_EQ(logs.size(), 1U);
  const std::size_t frames = replay(logs.front()).size();
  EXPECT_GE(frames, 15U);
  EXPECT_LE(frames, 20U);
}

}  // namespace
}  // namespace darkling
