// SPDX-License-Identifier: Apache-2.0
// The service under the one who starts it: notifications, signals, exit codes.
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/service_process.h"

namespace darkling {
namespace {

using test::kPatience;
using test::milliseconds;
using test::seconds;
using test::ServiceProcess;
using ::testing::HasSubstr;

TEST(Service, SaysWhenItIsReadyAndWhatItDoes) {
  ServiceProcess service;
  EXPECT_TRUE(service.notifications().wait_for("READY=1", kPatience));
  EXPECT_TRUE(service.notifications().wait_for("STATUS=state=TRACKING", kPatience));
}

TEST(Service, FeedsTheWatchdogAtLeastTwiceAPeriod) {
  ServiceProcess service({}, {}, milliseconds(1000));
  ASSERT_TRUE(service.notifications().wait_for("STATUS=state=TRACKING", kPatience));
  EXPECT_GE(service.notifications().count("WATCHDOG=1", milliseconds(3000)), 6);
}

TEST(Service, StopsWithinASecondOfSigterm) {
  ServiceProcess service;
  ASSERT_TRUE(service.notifications().wait_for("STATUS=state=TRACKING", kPatience));
  const auto asked_at = std::chrono::steady_clock::now();
  service.send_signal(SIGTERM);
  const auto run = service.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - asked_at, seconds(1));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(service.notifications().wait_for("STOPPING=1", milliseconds(100)));
  EXPECT_THAT(run.err, HasSubstr("service=stopped"));
}

TEST(Service, TellsOneLineForAChangeOfStateAndNoneForAFrame) {
  ServiceProcess service;
  ASSERT_TRUE(service.listener().wait_until(
      [](const test::Heard& heard) { return heard.poses.size() >= 40; }, kPatience));
  service.send_signal(SIGTERM);
  const std::string told = service.wait().err;
  EXPECT_LT(std::count(told.begin(), told.end(), '\n'), 10) << told;
}

TEST(Service, EndsAtOnceWithoutSayingReadyWhenItIsConfiguredWrong) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "typo.yaml", "camera: synthetic:mine\nwidht_px: 96\n");
  test::write_text(folder / "half.yaml", "camera: [synthetic:mi");
  test::write_text(folder / "empty.yaml", "");
  struct Case {
    std::string path;
    int status;
    std::string message;
  };
  const std::vector<Case> cases = {
      {folder / "typo.yaml", 78, "typo.yaml:2: unknown key 'widht_px', did you mean 'width_px'?"},
      {folder / "half.yaml", 78, "is not valid YAML"},
      {folder / "empty.yaml", 78, "no camera is configured"},
      {folder / "absent.yaml", 66, "No such file"},
      {folder.path(), 66, "Is a directory"},
  };
  for (const Case& wrong : cases) {
    ServiceProcess service({}, {"--config", wrong.path});
    const auto run = service.wait();
    EXPECT_EQ(run.status, wrong.status) << wrong.path;
    EXPECT_THAT(run.err, HasSubstr(wrong.message));
    EXPECT_FALSE(service.notifications().wait_for("READY=1", milliseconds(50)));
  }
}

class Reload : public ::testing::Test {
 protected:
  void configure(const std::string& more) const {
    test::write_text(
        path_, std::string("camera: \"") + (test::kSmallScene + 7) + "\"\nwidth_px: 96\n" + more);
  }

  const test::TemporaryFolder folder_;
  const std::string path_ = folder_ / "rover.yaml";
};

TEST_F(Reload, TakesAGoodFileAndCountsAReset) {
  configure("");
  ServiceProcess service({}, {"--config", path_});
  ASSERT_TRUE(service.reaches(status_t::STATE_TRACKING));
  configure("points_per_level: 200\n");
  service.send_signal(SIGHUP);
  EXPECT_TRUE(service.notifications().wait_for("RELOADING=1", kPatience));
  EXPECT_TRUE(service.notifications().wait_for("READY=1", kPatience));
  EXPECT_TRUE(service.listener().wait_until(
      [](const test::Heard& heard) {
        return !heard.poses.empty() && heard.poses.back().reset_counter == 1;
      },
      kPatience));
  service.send_signal(SIGTERM);
  EXPECT_THAT(service.wait().err, HasSubstr("reload=done"));
}

TEST_F(Reload, KeepsTheOldConfigurationWhenTheFileIsBad) {
  configure("");
  ServiceProcess service({}, {"--config", path_});
  ASSERT_TRUE(service.reaches(status_t::STATE_TRACKING));
  configure("points_per_levle: 200\n");
  service.send_signal(SIGHUP);
  EXPECT_TRUE(service.notifications().wait_for("RELOADING=1", kPatience));
  EXPECT_TRUE(service.notifications().wait_for("READY=1", kPatience));
  EXPECT_TRUE(service.reaches(status_t::STATE_TRACKING));
  EXPECT_EQ(service.listener().heard().poses.back().reset_counter, 0);
  service.send_signal(SIGTERM);
  EXPECT_THAT(service.wait().err,
              HasSubstr("rover.yaml:3: unknown key 'points_per_levle', did you mean"));
}

}  // namespace
}  // namespace darkling
