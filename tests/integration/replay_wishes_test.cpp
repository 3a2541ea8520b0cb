// SPDX-License-Identifier: Apache-2.0
// A replay does what the odometry was asked for when a log was recorded.
#include <array>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/framelog/frame_log.h"
#include "drivers/framelog/frame_log_writer.h"
#include "drivers/framelog/framelog_source.h"
#include "integration/darkling.h"
#include "messages/channels.h"
#include "messages/command_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/wire.h"
#include "support/tiny_dataset.h"

namespace darkling {
namespace {

using test::read_json;
using test::read_text;
using test::run_darkling;
using ::testing::HasSubstr;

using Bytes = std::vector<std::byte>;

template <class Message>
Bytes encode(const Message& message) {
  Bytes bytes(256);
  bytes.resize(encode_into(std::span(bytes), message));
  return bytes;
}

Bytes command(std::int8_t what) {
  command_t message = {};
  message.command = what;
  return encode(message);
}

std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream text(read_text(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// A log of a few small frames, and messages put between them.
class ReplayWishes : public ::testing::Test {
 protected:
  ReplayWishes() {
    test::write_tiny_kitti(folder_ / "kitti", {.frames = kFrames});
    EXPECT_EQ(run_darkling({"convert", folder_ / "kitti", plain_}).status, 0);
  }

  // @param messages  by the row that they come before.
  void write_log(const char* channel, const std::map<std::int64_t, Bytes>& messages) const {
    auto plain = open_frame_log(plain_);
    ASSERT_TRUE(plain) << plain.error().message;
    auto writer = FrameLogWriter::create(log_, plain->record);
    ASSERT_TRUE(writer) << writer.error().message;
    FramelogSource source(std::move(plain->events), std::move(plain->rows));
    ASSERT_TRUE(source.start());
    for (std::int64_t row = 0;; ++row) {
      const WaitResult next = source.wait_next(Duration::zero());
      if (next.status != WaitStatus::kFrame) break;
      const StereoFrame& frame = next.lease.frame();
      if (messages.contains(row)) {
        ASSERT_TRUE(writer->add_message(channel, messages.at(row), frame.stamp));
      }
      ASSERT_TRUE(writer->add_frame(frame));
    }
    ASSERT_TRUE(writer->close());
  }

  [[nodiscard]] test::ProgramResult replay(const std::string& path,
                                           const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words = {"replay",       path,   "--width", "96",
                                      "--trajectory", poses_, "--stats", stats_};
    words.insert(words.end(), options.begin(), options.end());
    return run_darkling(words);
  }
  // Of a run that has to end well.
  [[nodiscard]] std::vector<std::string> poses_of(
      const std::string& path, const std::vector<std::string>& options = {}) const {
    const auto run = replay(path, options);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return lines_of(poses_);
  }
  [[nodiscard]] int resets() const { return read_json(stats_)["resets"]; }

  static constexpr int kFrames = 8;
  static constexpr int kRow = 5;
  test::TemporaryFolder folder_;
  std::string plain_ = folder_ / "plain.lcmlog";
  std::string log_ = folder_ / "run.lcmlog";
  std::string poses_ = folder_ / "poses.txt";
  std::string stats_ = folder_ / "stats.json";
};

TEST_F(ReplayWishes, BeginsANewTrackAtAReset) {
  write_log(kCommandChannel, {{kRow, command(command_t::COMMAND_RESET)}});
  std::vector<std::string> expected = poses_of(plain_, {"--frames", "0:5"});
  for (const std::string& line : poses_of(plain_, {"--frames", "5:"})) expected.push_back(line);
  EXPECT_EQ(poses_of(log_), expected);
  EXPECT_EQ(resets(), 1);
  EXPECT_EQ(read_json(stats_)["heap_calls_after_start"], 0);
}

TEST_F(ReplayWishes, MakesAKeyframeAtAReseed) {
  static_cast<void>(poses_of(plain_));
  const int keyframes = read_json(stats_)["keyframes"];
  write_log(kCommandChannel, {{1, command(command_t::COMMAND_RESEED)},
                              {2, command(command_t::COMMAND_RESEED)},
                              {3, command(command_t::COMMAND_RESEED)}});
  static_cast<void>(poses_of(log_));
  EXPECT_GT(read_json(stats_)["keyframes"], keyframes);
  EXPECT_EQ(resets(), 0);
}

TEST_F(ReplayWishes, LetInjectionsPass) {
  write_log(kCommandChannel, {{kRow, command(command_t::COMMAND_RESET)}});
  static_cast<void>(poses_of(log_, {"--inject", "gain=1.1", "--inject", "drop=1@5:6"}));
  EXPECT_EQ(resets(), 1);
}

TEST_F(ReplayWishes, GoWithTheFramesThatAreLeftOut) {
  write_log(kCommandChannel, {{kRow, command(command_t::COMMAND_RESET)}});
  EXPECT_EQ(poses_of(log_, {"--stride", "2"}), poses_of(plain_, {"--stride", "2"}));
  EXPECT_EQ(resets(), 0);
  static_cast<void>(poses_of(log_, {"--frames", "1:", "--stride", "2"}));
  EXPECT_EQ(resets(), 1);
}

TEST_F(ReplayWishes, ArePassedOverAndCountedWhenTheyMakeNoSense) {
  hint_t hint = {};
  hint.rotation[0] = 1.001;
  write_log(kHintChannel, {{1, encode(hint)}, {2, Bytes(7)}, {3, Bytes(3000)}});
  const std::vector<std::string> expected = poses_of(plain_);
  const auto run = replay(log_);
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("3 records are damaged"));
  EXPECT_EQ(lines_of(poses_), expected);
}

TEST_F(ReplayWishes, AreNotForTheOdometryWhenTheyAskForRecordings) {
  write_log(kCommandChannel, {{1, command(command_t::COMMAND_START_RECORDING)}});
  EXPECT_EQ(poses_of(log_), poses_of(plain_));
}

// What `convert` makes of the log.
class ConvertWishes : public ReplayWishes {
 protected:
  [[nodiscard]] test::ProgramResult convert(const std::string& output,
                                            const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words = {"convert", log_, output};
    words.insert(words.end(), options.begin(), options.end());
    return run_darkling(words);
  }

  std::string copy_ = folder_ / "copy.lcmlog";
};

TEST_F(ConvertWishes, CarriesThemOverSoThatTheCopyReplaysTheSame) {
  write_log(kCommandChannel,
            {{2, command(command_t::COMMAND_RESEED)}, {kRow, command(command_t::COMMAND_RESET)}});
  const auto converted = convert(copy_);
  ASSERT_EQ(converted.status, 0) << converted.err;
  EXPECT_THAT(converted.out, HasSubstr("8 frames of run.lcmlog (frame log), 2 commands and hints"));
  const std::vector<std::string> expected = poses_of(log_);
  EXPECT_NE(expected, poses_of(plain_));
  EXPECT_EQ(poses_of(copy_), expected);
  EXPECT_EQ(resets(), 1);
}

TEST_F(ConvertWishes, TakesThoseOfTheFramesThatAreChosen) {
  write_log(kCommandChannel,
            {{2, command(command_t::COMMAND_RESET)}, {kRow, command(command_t::COMMAND_RESET)}});
  for (const std::vector<std::string>& choice :
       {std::vector<std::string>{"--frames", "3:"}, {"--frames", ":5"}, {"--stride", "2"}}) {
    ASSERT_EQ(convert(copy_, choice).status, 0);
    const std::vector<std::string> expected = poses_of(log_, choice);
    EXPECT_EQ(resets(), 1) << choice[1];
    EXPECT_EQ(poses_of(copy_), expected) << choice[1];
    EXPECT_EQ(resets(), 1) << choice[1];
    test::remove_path(copy_);
  }
}

TEST_F(ConvertWishes, KeepsEveryBitOfAHint) {
  hint_t hint = {};
  hint.rotation[0] = 0.8;
  hint.rotation[2] = 0.6;
  hint.translation[1] = 0.1;
  write_log(kHintChannel, {{3, encode(hint)}});
  ASSERT_EQ(convert(copy_).status, 0);
  const auto copy = open_frame_log(copy_);
  ASSERT_TRUE(copy) << copy.error().message;
  ASSERT_EQ(copy->messages.size(), 1u);
  EXPECT_STREQ(copy->messages[0].channel, kHintChannel);
  EXPECT_EQ(copy->messages[0].row, 3u);
  Bytes bytes(static_cast<std::size_t>(copy->messages[0].data_size));
  ASSERT_TRUE(copy->events.read_at(copy->messages[0].data_at, bytes));
  EXPECT_EQ(bytes, encode(hint));
  EXPECT_EQ(poses_of(copy_), poses_of(log_));
}

TEST_F(ConvertWishes, SaysThatAFolderCannotHoldThem) {
  write_log(kCommandChannel, {{kRow, command(command_t::COMMAND_RESET)}});
  const auto converted = convert(folder_ / "out", {"--format", "euroc"});
  ASSERT_EQ(converted.status, 0) << converted.err;
  EXPECT_THAT(converted.out, HasSubstr("1 commands and hints left out"));
}

}  // namespace
}  // namespace darkling
