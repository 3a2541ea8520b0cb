// SPDX-License-Identifier: Apache-2.0
// What the service records, and what a replay makes of it.
#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/service/follow_pair.h"
#include "app/service/obey_wish.h"
#include "app/service/wish_messages.h"
#include "drivers/framelog/frame_log.h"
#include "drivers/framelog/framelog_source.h"
#include "kernels/kernel_table.h"
#include "messages/channels.h"
#include "messages/command_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/wire.h"
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

// Every frame of a log, by its sequence number, as a replay estimates it.
std::map<std::int64_t, Estimate> replay(const std::string& path) {
  auto log = open_frame_log(path);
  EXPECT_TRUE(log) << log.error().message;
  EXPECT_EQ(describe_damage(*log), "");
  const auto kernels = select_kernels("auto", detect_cpu_features());
  auto odometry = Odometry::create({.width_px = 96}, log->rig, *kernels, read_monotonic_clock);
  EXPECT_TRUE(odometry);
  const std::vector<RecordedWish> wishes = read_wishes(*log).wishes;
  auto wish = wishes.begin();
  FramelogSource source(std::move(log->events), std::move(log->rows));
  EXPECT_TRUE(source.start());
  std::map<std::int64_t, Estimate> estimates;
  for (;;) {
    const WaitResult next = source.wait_next(std::chrono::seconds(1));
    if (next.status == WaitStatus::kEndOfSource) break;
    const bool is_frame = next.status == WaitStatus::kFrame;
    const std::int64_t sequence = is_frame ? next.lease.frame().sequence : next.sequence;
    for (; wish != wishes.end() && wish->sequence == sequence; ++wish) {
      obey_wish(**odometry, wish->wish);
    }
    estimates.emplace(sequence, follow_pair(**odometry, next));
  }
  return estimates;
}

void expect_same_bytes(const std::vector<pose_t>& published,
                       const std::map<std::int64_t, Estimate>& replayed) {
  for (const pose_t& pose : published) {
    ASSERT_TRUE(replayed.contains(pose.seq)) << pose.seq;
    const Estimate& estimate = replayed.at(pose.seq);
    const Vector3 t(pose.translation[0], pose.translation[1], pose.translation[2]);
    const Eigen::Quaterniond q(pose.rotation[0], pose.rotation[1], pose.rotation[2],
                               pose.rotation[3]);
    EXPECT_EQ(estimate.T_world_body.translation(), t) << pose.seq;
    EXPECT_EQ(estimate.T_world_body.rotation().coeffs(), q.coeffs()) << pose.seq;
    EXPECT_EQ(estimate.reset_counter, pose.reset_counter) << pose.seq;
  }
}

std::size_t count(const std::vector<RecordedWish>& wishes, Wish::Kind kind) {
  return static_cast<std::size_t>(
      std::ranges::count_if(wishes, [&](const auto& w) { return w.wish.kind == kind; }));
}

// A motion that no frame of the scene makes: where it is the best guess, estimates show it.
void send_hint(test::Listener& listener) {
  hint_t message = {};
  message.utime_to = to_ns(read_epoch_clock()) / 1000;
  message.utime_from = message.utime_to - 70'000;
  const Se3 T_from_to = Se3::exp((Vector6() << 0.031, -0.012, 0.007, 0.01, 0.02, -0.03).finished());
  std::copy_n(T_from_to.translation().data(), 3, message.translation);
  const Eigen::Quaterniond& q = T_from_to.rotation();
  const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
  std::copy(wxyz.begin(), wxyz.end(), message.rotation);
  message.valid_for_ms = 1000;
  std::array<std::byte, 128> bytes;
  listener.send(kHintChannel, bytes.data(), encode_into(std::span(bytes), message));
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
  const Heard heard = service.listener().heard();
  ASSERT_EQ(heard.statuses.back().record_drops, 0);
  expect_same_bytes(heard.poses, replay(logs.front()));
}

TEST(Recording, ReplaysToTheSameBytesWithTheCommandsAndHintsThatCameOnTheWay) {
  const test::TemporaryFolder folder;
  ServiceProcess service({"record_to=" + folder.path(), "record=true"});
  test::Listener& listener = service.listener();
  ASSERT_TRUE(
      listener.wait_until([](const Heard& heard) { return heard.poses.size() >= 20; }, kPatience));
  // Again and again: the service may not listen yet.
  const auto has_been_reset = [](const Heard& heard) {
    return heard.poses.back().reset_counter > 1;
  };
  for (int i = 0; i < 200 && !has_been_reset(listener.heard()); ++i) {
    send_hint(listener);
    listener.send_command(command_t::COMMAND_RESEED);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    send_hint(listener);
    listener.send_command(command_t::COMMAND_RESET);
    send_hint(listener);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
  }
  ASSERT_TRUE(has_been_reset(listener.heard()));
  const std::size_t so_far = listener.heard().poses.size();
  ASSERT_TRUE(listener.wait_until(
      [&](const Heard& heard) { return heard.poses.size() >= so_far + 20; }, kPatience));
  service.send_signal(SIGTERM);
  ASSERT_EQ(service.wait().status, 0);
  const std::vector<std::string> logs = logs_in(folder.path(), "darkling-");
  ASSERT_EQ(logs.size(), 1U);
  const auto log = open_frame_log(logs.front());
  ASSERT_TRUE(log) << log.error().message;
  const RecordedWishes recorded = read_wishes(*log);
  EXPECT_EQ(recorded.unreadable, 0);
  EXPECT_GE(count(recorded.wishes, Wish::Kind::kReset), 2U);
  EXPECT_GE(count(recorded.wishes, Wish::Kind::kReseed), 2U);
  EXPECT_GE(count(recorded.wishes, Wish::Kind::kHint), 2U);
  const Heard heard = listener.heard();
  ASSERT_EQ(heard.statuses.back().record_drops, 0);
  expect_same_bytes(heard.poses, replay(logs.front()));
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
