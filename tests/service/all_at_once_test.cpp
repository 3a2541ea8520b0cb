// SPDX-License-Identifier: Apache-2.0
// Everything that the threads share, used at the same time: above all for the thread sanitizer.
#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/service/pipeline.h"
#include "messages/command_t.hpp"
#include "service/scripted_source.h"
#include "service/service_process.h"

namespace darkling {
namespace {

using test::Heard;
using test::kPatience;
using test::milliseconds;
using test::seconds;
using test::ServiceProcess;
using ::testing::HasSubstr;

void send_everything(test::Listener& listener) {
  for (std::int8_t command = command_t::COMMAND_RESET;
       command <= command_t::COMMAND_WRITE_BLACK_BOX; ++command) {
    listener.send_command(command);
    listener.send_hint();
  }
}

// A recording: the camera of the test that needs one that ends.
std::string record(const std::string& folder, std::size_t frames) {
  ServiceProcess service({"record_to=" + folder, "record=true"});
  EXPECT_TRUE(service.listener().wait_until(
      [&](const Heard& heard) { return heard.poses.size() >= frames; }, kPatience));
  service.send_signal(SIGTERM);
  EXPECT_EQ(service.wait().status, 0);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    return entry.path().string();
  }
  return "";
}

TEST(AllAtOnce, CommandsHintsReloadsAndRecordingsLeaveTheServiceTracking) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "rover.yaml";
  const auto configure = [&](const std::string& more) {
    test::write_text(path, std::string("camera: \"") + (test::kSmallScene + 7) +
                               "\"\nwidth_px: 96\nrate_hz: 60\nrecord_to: \"" + folder.path() +
                               "\"\nrecord: true\nblack_box_s: 1\nbot_core_pose: true\n" + more);
  };
  configure("");
  ServiceProcess service({}, {"--config", path});
  ASSERT_TRUE(service.reaches(status_t::STATE_TRACKING));
  for (const char* more : {"points_per_level: 200\n", "points_per_levle: 200\n", ""}) {
    for (int i = 0; i < 20; ++i) {
      send_everything(service.listener());
      std::this_thread::sleep_for(milliseconds(50));
    }
    configure(more);
    service.send_signal(SIGHUP);
    ASSERT_TRUE(service.notifications().wait_for("RELOADING=1", kPatience));
    ASSERT_TRUE(service.notifications().wait_for("READY=1", kPatience));
    ASSERT_TRUE(service.reaches(status_t::STATE_TRACKING));
  }
  send_everything(service.listener());
  service.send_signal(SIGTERM);
  const auto run = service.wait();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("reload=done"));
  EXPECT_THAT(run.err, HasSubstr("reload=refused"));
  EXPECT_THAT(run.err, HasSubstr("recording=stopped"));
  EXPECT_THAT(run.err, HasSubstr("black_box="));
}

TEST(AllAtOnce, AFrameLogIsACameraThatIsOpenedAgainByAReloadAndEnds) {
  const test::TemporaryFolder folder;
  const std::string log = record(folder.path(), 80);
  ASSERT_NE(log, "");
  const test::TemporaryFolder recorded;
  const std::string path = recorded / "rover.yaml";
  test::write_text(path, "camera: \"" + log + "\"\nwidth_px: 96\nrecord_to: \"" + recorded.path() +
                             "\"\nblack_box_s: 1\n");
  ServiceProcess service({}, {"--config", path});
  ASSERT_TRUE(service.reaches(status_t::STATE_TRACKING));
  send_everything(service.listener());
  service.send_signal(SIGHUP);
  const auto run = service.wait();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("reload=done"));
  EXPECT_THAT(run.err, HasSubstr("service=stopped"));
}

TEST(AllAtOnce, ACameraIsLostAndFoundWhileItsPairsAreRecorded) {
  const test::TemporaryFolder folder;
  const auto& scene = test::synthetic_run("corridor,frames=6,width=96,seed=3");
  const std::string url = test::new_lcm_url();
  test::Listener listener(url);
  Config config;
  config.odometry.width_px = 96;
  config.camera.rate_hz = 50.0;
  config.service.lcm_url = url;
  config.service.record_to = folder.path();
  config.service.record = true;
  config.service.black_box_s = 1.0;
  auto source = std::make_unique<test::ScriptedSource>(scene);
  test::ScriptedSource& camera = *source;
  auto pipeline =
      Pipeline::create(config, {.name = "scripted", .source = std::move(source), .rig = scene.rig});
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  (*pipeline)->start(0);
  const auto reaches = [&](std::int8_t state) {
    return listener.wait_until(
        [&](const Heard& h) { return !h.statuses.empty() && h.statuses.back().state == state; },
        kPatience);
  };
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  for (int i = 0; i < 2; ++i) {
    send_everything(listener);
    camera.is_absent = true;
    ASSERT_TRUE(reaches(status_t::STATE_NO_CAMERA));
    send_everything(listener);
    camera.is_absent = false;
    ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
    camera.has_bad_frames = true;
    ASSERT_TRUE(reaches(status_t::STATE_LOST));
    camera.has_bad_frames = false;
    ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  }
  EXPECT_EQ(camera.starts, 3);
  EXPECT_EQ(camera.most_leases, 0);
}

}  // namespace
}  // namespace darkling
