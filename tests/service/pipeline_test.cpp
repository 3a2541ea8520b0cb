// SPDX-License-Identifier: Apache-2.0
// The threads of the service around a camera with every fault, in this process.
#include "app/service/pipeline.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "service/listener.h"
#include "service/patience.h"
#include "service/scripted_source.h"

namespace darkling {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::Heard;
using test::kPatience;

class EachPipeline : public ::testing::Test {
 protected:
  EachPipeline()
      : run_(test::synthetic_run("corridor,frames=6,width=96,seed=3")),
        url_(test::new_lcm_url()),
        listener_(url_) {
    config_.odometry.width_px = 96;
    config_.camera.rate_hz = 50.0;
    config_.service.lcm_url = url_;
  }

  void start() {
    auto source = std::make_unique<test::ScriptedSource>(run_);
    source_ = source.get();
    auto pipeline = Pipeline::create(
        config_, {.name = "scripted", .source = std::move(source), .rig = run_.rig});
    ASSERT_TRUE(pipeline) << pipeline.error().message;
    pipeline_ = std::move(*pipeline);
    pipeline_->start(0);
  }

  // What the watchdog is fed by.
  [[nodiscard]] bool are_threads_alive() const {
    return pipeline_->status().are_threads_alive(read_monotonic_clock());
  }

  // @return whether a status that comes from now on says so.
  [[nodiscard]] bool reaches(std::int8_t state) const {
    const std::size_t before = listener_.heard().statuses.size();
    return listener_.wait_until(
        [&](const Heard& heard) {
          return std::any_of(heard.statuses.begin() + static_cast<std::ptrdiff_t>(before),
                             heard.statuses.end(),
                             [&](const status_t& s) { return s.state == state; });
        },
        kPatience);
  }

  const test::SyntheticRun& run_;
  std::string url_;
  test::Listener listener_;
  Config config_;
  test::ScriptedSource* source_ = nullptr;
  std::unique_ptr<Pipeline> pipeline_;
};

TEST_F(EachPipeline, OpensALostCameraAgainAndTracksOn) {
  start();
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  source_->is_absent = true;
  ASSERT_TRUE(reaches(status_t::STATE_NO_CAMERA));
  const std::size_t statuses = listener_.heard().statuses.size();
  EXPECT_TRUE(listener_.wait_until(
      [&](const Heard& heard) { return heard.statuses.size() >= statuses + 3; }, seconds(3)));
  EXPECT_TRUE(are_threads_alive());
  source_->is_absent = false;
  const auto back_at = std::chrono::steady_clock::now();
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  EXPECT_LT(std::chrono::steady_clock::now() - back_at, seconds(3));
  EXPECT_EQ(source_->starts, 2);
  EXPECT_EQ(source_->stops, 1);
  EXPECT_EQ(source_->most_leases, 0);
}

TEST_F(EachPipeline, SaysFaultAndStarvesTheWatchdogWhenACameraHangs) {
  start();
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  source_->is_hanging = true;
  ASSERT_TRUE(reaches(status_t::STATE_FAULT));
  EXPECT_FALSE(are_threads_alive());
  source_->is_hanging = false;
  EXPECT_TRUE(reaches(status_t::STATE_TRACKING));
  EXPECT_TRUE(are_threads_alive());
}

TEST_F(EachPipeline, CallsASilentCameraGoneButDoesNotGiveItUp) {
  start();
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  source_->is_silent = true;
  ASSERT_TRUE(reaches(status_t::STATE_NO_CAMERA));
  source_->is_silent = false;
  EXPECT_TRUE(reaches(status_t::STATE_TRACKING));
  EXPECT_EQ(source_->starts, 1);
}

TEST_F(EachPipeline, PublishesLostForPairsThatCannotBeUsed) {
  start();
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  source_->has_bad_frames = true;
  ASSERT_TRUE(reaches(status_t::STATE_LOST));
  const update_t update = listener_.heard().updates.back();
  EXPECT_EQ(update.status, update_t::STATUS_LOST);
  EXPECT_EQ(update.quality, update_t::QUALITY_FAILED);
  EXPECT_EQ(update.reasons, update_t::REASON_UNSYNCED);
  EXPECT_EQ(update.covariance[0], update_t::UNKNOWN_VARIANCE);
  source_->has_bad_frames = false;
  EXPECT_TRUE(reaches(status_t::STATE_TRACKING));
}

TEST_F(EachPipeline, PublishesStampsOfTheFutureAmongTheErrorsOfTheDevice) {
  start();
  ASSERT_TRUE(reaches(status_t::STATE_TRACKING));
  EXPECT_EQ(listener_.heard().statuses.back().device_errors, 0);
  source_->stamps_of_future = 7;
  EXPECT_TRUE(listener_.wait_until(
      [](const Heard& heard) { return heard.statuses.back().device_errors == 7; }, seconds(3)));
}

TEST_F(EachPipeline, WaitsForACameraThatIsNotThereYet) {
  auto source = std::make_unique<test::ScriptedSource>(run_);
  source->is_absent = true;
  test::ScriptedSource* camera = source.get();
  pipeline_ = std::move(*Pipeline::create(
      config_, {.name = "scripted", .source = std::move(source), .rig = run_.rig}));
  pipeline_->start(0);
  ASSERT_TRUE(reaches(status_t::STATE_NO_CAMERA));
  camera->is_absent = false;
  EXPECT_TRUE(reaches(status_t::STATE_TRACKING));
}

TEST_F(EachPipeline, PublishesEverythingOfASourceThatEnds) {
  start();
  source_->last_frame = 30;
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (!pipeline_->is_over() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  ASSERT_TRUE(pipeline_->is_over());
  const PipelineStatus& status = pipeline_->status();
  const std::int64_t passed_over = status.pairs_skipped.get() + status.pairs_refused.get();
  pipeline_.reset();
  EXPECT_TRUE(listener_.wait_until(
      [&](const Heard& heard) {
        return static_cast<std::int64_t>(heard.poses.size()) == 31 - passed_over;
      },
      seconds(2)));
}

TEST_F(EachPipeline, StopsInTimeWhateverTheCameraDoes) {
  for (const bool is_silent : {false, true}) {
    start();
    source_->is_silent = is_silent;
    std::this_thread::sleep_for(milliseconds(300));
    const auto asked_at = std::chrono::steady_clock::now();
    pipeline_.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - asked_at, milliseconds(900));
  }
}

}  // namespace
}  // namespace darkling
