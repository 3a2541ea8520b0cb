// SPDX-License-Identifier: Apache-2.0
// What a receiver hears over LCM.
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "geometry/se3.h"
#include "messages/command_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/wire.h"
#include "service/service_process.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::Heard;
using test::kPatience;
using test::milliseconds;
using test::seconds;
using test::ServiceProcess;

template <class Message>
Se3 transform_of(const Message& m) {
  return Se3(Eigen::Quaterniond(m.rotation[0], m.rotation[1], m.rotation[2], m.rotation[3]),
             Vector3(m.translation[0], m.translation[1], m.translation[2]));
}

bool has_poses(const Heard& heard, std::size_t count) {
  return heard.poses.size() >= count && heard.updates.size() >= count;
}

TEST(Published, EveryFrameOnceInOrderWithMotionsThatLeadToThePoses) {
  ServiceProcess service;
  constexpr std::size_t kFrames = 50;
  ASSERT_TRUE(service.listener().wait_until(
      [&](const Heard& heard) { return has_poses(heard, kFrames); }, kPatience));
  const Heard heard = service.listener().heard();
  Se3 T_world_body = transform_of(heard.poses[0]);
  for (std::size_t i = 1; i < kFrames; ++i) {
    const update_t& update = heard.updates[i];
    ASSERT_EQ(update.seq, heard.poses[i].seq);
    EXPECT_GT(update.seq, heard.updates[i - 1].seq);
    EXPECT_EQ(update.prev_utime, heard.updates[i - 1].utime);
    EXPECT_GT(update.mono_ns, heard.updates[i - 1].mono_ns);
    T_world_body = T_world_body * transform_of(update);
    // Poses follow refinements little by little; motions do not.
    EXPECT_LT((T_world_body.translation() - transform_of(heard.poses[i]).translation()).norm(),
              0.02)
        << i;
  }
}

TEST(Published, StatusTwiceASecondWithWhatTheServiceIs) {
  ServiceProcess service({"channel_prefix=ROVER.7_"});
  ASSERT_TRUE(service.reaches(status_t::STATE_TRACKING));
  const std::size_t before = service.listener().heard().statuses.size();
  std::this_thread::sleep_for(seconds(3));
  const auto statuses = service.listener().heard().statuses;
  EXPECT_GE(statuses.size() - before, 5U);
  EXPECT_LE(statuses.size() - before, 7U);
  const status_t& last = statuses.back();
  EXPECT_EQ(last.width, 96);
  EXPECT_EQ(last.camera, std::string(test::kSmallScene).substr(7));
  EXPECT_GT(last.arena_bytes, 100'000);
  EXPECT_GT(last.rss_bytes, 1'000'000);
  EXPECT_EQ(last.heap_calls, test::kIsSanitized ? -1 : 0);  // -1: not counted
  EXPECT_FALSE(last.kernels.empty());
  EXPECT_GT(last.frames_tracked, 20);
  EXPECT_EQ(last.frames_lost, 0);
  EXPECT_GT(last.latency_p50_ms, 0.0);
}

TEST(Published, NothingButStatusWithoutACamera) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "camchain.yaml", test::tiny_camchain({.width = 128, .height = 96}));
  ServiceProcess service({"camera=v4l2:/dev/no_such_video", "layout=side_by_side", "width_px=96",
                          "calibration=" + (folder / "camchain.yaml")});
  ASSERT_TRUE(service.notifications().wait_for("READY=1", kPatience));
  ASSERT_TRUE(service.reaches(status_t::STATE_NO_CAMERA));
  EXPECT_TRUE(service.listener().wait_until(
      [](const Heard& heard) { return heard.statuses.size() >= 4; }, seconds(5)));
  EXPECT_TRUE(service.listener().heard().poses.empty());
  EXPECT_TRUE(service.notifications().wait_for("WATCHDOG=1", seconds(2)));
  service.send_signal(SIGTERM);
  const auto run = service.wait();
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("state=NO_CAMERA error=\""), std::string::npos) << run.err;
}

class Commands : public ::testing::Test {
 protected:
  // The service begins to listen some time after it begins to speak: asks until it was heard.
  [[nodiscard]] bool send_until(std::int8_t command,
                                const std::function<bool(const Heard&)>& is_so) {
    for (int i = 0; i < 20; ++i) {
      service_.listener().send_command(command);
      if (service_.listener().wait_until(is_so, seconds(1))) return true;
    }
    return false;
  }

  ServiceProcess service_;
};

TEST_F(Commands, ResetBringsThePoseBackToTheOriginAndIsCounted) {
  ASSERT_TRUE(service_.reaches(status_t::STATE_TRACKING));
  ASSERT_TRUE(send_until(command_t::COMMAND_RESET,
                         [](const Heard& heard) { return heard.poses.back().reset_counter >= 1; }));
  const Heard heard = service_.listener().heard();
  const auto first = std::find_if(heard.poses.begin(), heard.poses.end(),
                                  [](const pose_t& p) { return p.reset_counter == 1; });
  EXPECT_LT(transform_of(*first).translation().norm(), 1e-9);
  EXPECT_EQ(first->status, pose_t::STATUS_VALID);
}

TEST_F(Commands, ZeroCountersLetsThemBeginAnew) {
  ASSERT_TRUE(service_.listener().wait_until(
      [](const Heard& h) { return !h.statuses.empty() && h.statuses.back().frames_in > 30; },
      kPatience));
  EXPECT_TRUE(send_until(command_t::COMMAND_ZERO_COUNTERS,
                         [](const Heard& h) { return h.statuses.back().frames_in < 25; }));
}

TEST_F(Commands, NoMessageWhateverItIsDoesHarm) {
  ASSERT_TRUE(service_.reaches(status_t::STATE_TRACKING));
  test::Random random(5);
  std::array<std::uint8_t, 200> bytes;
  for (int i = 0; i < 500; ++i) {
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
    const auto size = static_cast<std::size_t>(random.uniform(1.0, 200.0));
    // Half of them with a fingerprint that is right.
    if (i % 2 == 0) {
      const std::int64_t hash = i % 4 == 0 ? hint_t::getHash() : command_t::getHash();
      for (int k = 0; k < 8; ++k) {
        bytes[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(hash >> (8 * (7 - k)));
      }
    }
    service_.listener().send(i % 3 == 0 ? "VO_HINT" : "VO_COMMAND", bytes.data(), size);
  }
  // Nonsense of the right shape.
  for (const double value : {std::nan(""), HUGE_VAL, 1e300, 0.0}) {
    hint_t hint = {};
    hint.utime_from = 1;
    hint.utime_to = 2;
    hint.valid_for_ms = 1;
    for (double& t : hint.translation) t = value;
    for (double& q : hint.rotation) q = value;
    const std::size_t size = encode_into(std::as_writable_bytes(std::span(bytes)), hint);
    service_.listener().send("VO_HINT", bytes.data(), size);
  }
  const std::size_t before = service_.listener().heard().poses.size();
  EXPECT_TRUE(service_.listener().wait_until(
      [&](const Heard& heard) { return heard.poses.size() > before + 20; }, kPatience));
  EXPECT_TRUE(service_.reaches(status_t::STATE_TRACKING));
}

}  // namespace
}  // namespace darkling
