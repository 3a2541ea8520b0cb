// SPDX-License-Identifier: Apache-2.0
// `darkling replay --log` writes what the run saw and said, and that replays the same.
#include <cmath>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/framelog/frame_log.h"
#include "drivers/framelog/frame_log_writer.h"
#include "integration/darkling.h"
#include "messages/channels.h"
#include "messages/command_t.hpp"
#include "messages/pose_t.hpp"
#include "messages/status_t.hpp"
#include "messages/update_t.hpp"
#include "messages/wire.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::read_json;
using test::read_text;
using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

class ReplayLog : public ::testing::Test {
 protected:
  ReplayLog() {
    test::write_tiny_euroc(dataset_, {.frames = kFrames});
    test::truncate_file(dataset_ + "/mav0/cam1/data/" + test::euroc_image_name(kBad), 0.5);
  }

  [[nodiscard]] test::ProgramResult replay(const std::string& source,
                                           const std::vector<std::string>& options) const {
    std::vector<std::string> words = {"replay", source,     "--width", "96",      "--trajectory",
                                      poses_,   "--format", "tum",     "--stats", stats_};
    words.insert(words.end(), options.begin(), options.end());
    return run_darkling(words);
  }
  // A log that has to get written.
  [[nodiscard]] test::ProgramResult write_log(const std::string& source,
                                              const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words = options;
    words.insert(words.end(), {"--log", log_});
    const auto run = replay(source, words);
    EXPECT_EQ(run.status, 0) << run.err;
    return run;
  }
  void expect_log_replays_the_same(const std::string& source,
                                   const std::vector<std::string>& options = {}) const {
    const auto written = write_log(source, options);
    const nlohmann::json first = read_json(stats_);
    const std::string poses = read_text(poses_);
    const auto again = replay(log_, {});
    EXPECT_EQ(again.status, 0);
    EXPECT_EQ(again.err, "");
    EXPECT_EQ(read_text(poses_), poses);
    for (const char* key : {"trajectory_sha256", "frames", "lost_frames", "resets", "keyframes",
                            "ate_rmse_m", "truth_poses"}) {
      EXPECT_EQ(read_json(stats_)[key], first[key]) << key << " of " << source;
    }
  }

  // Every message of one channel, decoded.
  template <class Message>
  [[nodiscard]] std::vector<Message> messages_of(const std::string& channel) const {
    std::vector<Message> messages;
    auto events = LogEvents::open(log_);
    EXPECT_TRUE(events);
    while (const auto event = events->next()) {
      if (event->channel != channel) continue;
      std::vector<std::byte> bytes(static_cast<std::size_t>(event->data_size));
      EXPECT_TRUE(events->read_at(event->data_at, bytes));
      EXPECT_TRUE(decode_from(bytes, messages.emplace_back()));
      EXPECT_EQ(event->timestamp_us, messages.back().mono_ns / 1000);
    }
    return messages;
  }
  [[nodiscard]] std::map<std::string, int> count_channels() const {
    std::map<std::string, int> counts;
    auto events = LogEvents::open(log_);
    EXPECT_TRUE(events);
    while (const auto event = events->next()) ++counts[std::string(event->channel)];
    EXPECT_EQ(events->damaged_bytes() + events->torn_bytes(), 0);
    return counts;
  }

  static constexpr int kFrames = 12;  // at 20 Hz
  static constexpr int kBad = 7;
  test::TemporaryFolder folder_;
  std::string dataset_ = folder_ / "euroc";
  std::string log_ = folder_ / "run.lcmlog";
  std::string poses_ = folder_ / "poses.tum";
  std::string stats_ = folder_ / "stats.json";
};

TEST_F(ReplayLog, ReplaysToTheSamePosesAndErrors) {
  expect_log_replays_the_same(dataset_);
  EXPECT_EQ(read_json(stats_)["frames"], kFrames);
  EXPECT_GT(read_json(stats_)["truth_poses"], 0);
}

TEST_F(ReplayLog, HoldsInjectedFaultsAndTheFramesThatWereChosen) {
  expect_log_replays_the_same("synthetic:mine,frames=12,width=96,seed=2",
                              {"--inject", "gain=1.5@4:6", "--inject", "drop=1@8:9"});
  std::filesystem::remove(log_);
  expect_log_replays_the_same(dataset_, {"--frames", "2:11", "--stride", "2"});
}

TEST_F(ReplayLog, KeepsWhatTheOdometryWasAskedFor) {
  ASSERT_EQ(run_darkling({"convert", dataset_, folder_ / "plain.lcmlog"}).status, 0);
  auto plain = open_frame_log(folder_ / "plain.lcmlog");
  ASSERT_TRUE(plain);
  const std::string asked = folder_ / "asked.lcmlog";
  auto writer = FrameLogWriter::create(asked, plain->record);
  ASSERT_TRUE(writer);
  test::GreyImage image;
  for (int k = 0; k < kFrames; ++k) {
    command_t reset = {};
    reset.command = command_t::COMMAND_RESET;
    std::vector<std::byte> bytes(64);
    bytes.resize(encode_into(std::span(bytes), reset));
    const FrameTime stamp = frame_time_from_ns(test::euroc_stamp_ns(k));
    if (k == 4) {
      ASSERT_TRUE(writer->add_message(kCommandChannel, bytes, stamp));
    }
    const auto left = test::tiny_image({}, k, false);
    const auto right = test::tiny_image({}, k, true);
    ASSERT_TRUE(writer->add_frame(
        {.sequence = k,
         .stamp = stamp,
         .left = {left.pixels.data(), left.width, left.height, left.width},
         .right = {right.pixels.data(), right.width, right.height, right.width}}));
  }
  ASSERT_TRUE(writer->close());
  expect_log_replays_the_same(asked);
  EXPECT_EQ(read_json(stats_)["resets"], 1);
}

TEST_F(ReplayLog, HasTheMessagesOfTheServiceBehindEveryPair) {
  const auto run = write_log(dataset_);
  EXPECT_THAT(run.out, HasSubstr("frame log   " + log_));
  EXPECT_THAT(count_channels(),
              UnorderedElementsAre(Pair(kRigChannel, 1), Pair(kTruthChannel, 1),
                                   Pair(kFrameChannel, kFrames - 1), Pair(kGapChannel, 1),
                                   Pair(kUpdateChannel, kFrames), Pair(kPoseChannel, kFrames),
                                   Pair(kStatusChannel, 3)));
  const auto updates = messages_of<update_t>(kUpdateChannel);
  const auto poses = messages_of<pose_t>(kPoseChannel);
  std::istringstream rows(read_text(poses_));
  for (std::size_t k = 0; k < updates.size(); ++k) {
    double stamp_s = 0.0;
    double x_m = 0.0;
    rows >> stamp_s >> x_m;
    rows.ignore(1000, '\n');
    EXPECT_EQ(updates[k].mono_ns, test::euroc_stamp_ns(static_cast<int>(k)));
    EXPECT_EQ(updates[k].utime, updates[k].mono_ns / 1000);
    EXPECT_EQ(updates[k].prev_utime, k == 0 ? 0 : updates[k - 1].utime);
    EXPECT_EQ(updates[k].status == update_t::STATUS_LOST, k == kBad);
    EXPECT_EQ(poses[k].seq, updates[k].seq);
    EXPECT_NEAR(poses[k].translation[0], x_m, 1e-6);
  }
}

TEST_F(ReplayLog, SaysTwiceASecondHowItIs) {
  static_cast<void>(write_log(dataset_));
  const auto statuses = messages_of<status_t>(kStatusChannel);
  ASSERT_EQ(statuses.size(), 3u);
  EXPECT_EQ(statuses[0].frames_in, 1);
  EXPECT_EQ(statuses[1].frames_in, 11);
  EXPECT_NEAR(statuses[1].rate_in_hz, 20.0, 1e-6);
  EXPECT_EQ(statuses[2].frames_in, kFrames);
  EXPECT_EQ(statuses[2].frames_bad, 1);
  EXPECT_EQ(statuses[2].frames_tracked, kFrames - 1);
  EXPECT_EQ(statuses[2].state, status_t::STATE_TRACKING);
  EXPECT_NE(statuses[1].reasons & update_t::REASON_DROPPED, 0);
  EXPECT_EQ(statuses[2].width, 96);
  EXPECT_EQ(statuses[2].latency_p50_ms, -1.0);
  EXPECT_EQ(statuses[2].camera, dataset_);
}

TEST_F(ReplayLog, NamesItsChannelsAsConfigured) {
  static_cast<void>(
      write_log(dataset_, {"--set", "channel_prefix=ROVER_", "--set", "bot_core_pose=true"}));
  const auto channels = count_channels();
  for (const char* channel : {"ROVER_VO_UPDATE", "ROVER_VO_POSE", "ROVER_POSE"}) {
    EXPECT_TRUE(channels.contains(channel) && channels.at(channel) == kFrames) << channel;
  }
  EXPECT_FALSE(channels.contains(kUpdateChannel));
  EXPECT_EQ(replay(log_, {}).status, 0);
}

TEST_F(ReplayLog, IsTheSameBytesAgainUnderAnotherNameAndWritesNothingOver) {
  static_cast<void>(write_log(dataset_));
  const std::string first = read_text(log_);
  const auto run = write_log(dataset_);
  const std::string second = folder_ / "run-2.lcmlog";
  EXPECT_THAT(run.out, HasSubstr("frame log   " + second));
  EXPECT_TRUE(read_text(log_) == first);
  EXPECT_TRUE(read_text(second) == first);
  static_cast<void>(write_log(log_));  // even of itself
  EXPECT_TRUE(read_text(log_) == first);
}

TEST_F(ReplayLog, IsRefusedWhereItCannotBeWrittenBeforeTheRun) {
  const auto expect_refused = [&](const std::string& path, const char* reason) {
    const auto run = replay(dataset_, {"--log", path});
    EXPECT_EQ(run.status, 64);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, AllOf(HasSubstr(path), HasSubstr(reason)));
  };
  expect_refused(folder_ / "absent/run.lcmlog", "cannot be opened for writing");
  expect_refused(dataset_, "is a folder");
  const auto run = run_darkling({"replay", folder_ / "absent", "--log", log_});
  EXPECT_EQ(run.status, 66);
  EXPECT_FALSE(std::filesystem::exists(log_));
}

}  // namespace
}  // namespace darkling
