// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/frame_log.h"

#include <cstring>

#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>

#include "drivers/framelog/rig_record.h"
#include "messages/channels.h"
#include "messages/frame_t.hpp"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"

namespace darkling {
namespace {

using test::event_starts;
using test::kTinyFrames;
using test::read_text;
using test::TemporaryFolder;
using test::write_text;
using test::write_tiny_frame_log;

class FrameLogFile : public testing::Test {
 protected:
  FrameLogFile() {
    write_tiny_frame_log(path_);
    content_ = read_text(path_);
    starts_ = event_starts(content_);
  }
  [[nodiscard]] Result<FrameLog> open_with(const std::string& content) const {
    write_text(path_, content);
    return open_frame_log(path_);
  }
  [[nodiscard]] Error refusal(const std::string& content) const {
    const auto log = open_with(content);
    return log ? Error{ExitCode::kDone, "it was opened"} : log.error();
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "run.lcmlog";
  std::string content_;
  std::vector<std::size_t> starts_;  // rig, truth, frame, frame, gap, frame, frame, end
};

TEST_F(FrameLogFile, BringsBackTheRigToTheBit) {
  const auto log = open_frame_log(path_);
  ASSERT_TRUE(log) << log.error().message;
  rig_t back = to_rig_record(log->rig);
  const rig_t sent = to_rig_record(test::tiny_log_rig());
  EXPECT_EQ(std::memcmp(&back.intrinsics, &sent.intrinsics, sizeof(sent.intrinsics)), 0);
  EXPECT_EQ(std::memcmp(&back.distortion, &sent.distortion, sizeof(sent.distortion)), 0);
  EXPECT_EQ(std::memcmp(&back.translation, &sent.translation, sizeof(sent.translation)), 0);
  EXPECT_EQ(std::memcmp(&back.rotation, &sent.rotation, sizeof(sent.rotation)), 0);
  EXPECT_EQ(log->rig.left.distortion, Distortion::kRadTan);
  EXPECT_EQ(log->rig.left.width, test::kTinyWidth);
  EXPECT_EQ(log->record.config, "width_px: 6\n");
  ASSERT_TRUE(log->truth);
  EXPECT_EQ(log->truth->poses, test::tiny_truth().poses);
  EXPECT_EQ(describe_damage(*log), "");
}

TEST_F(FrameLogFile, ListsFramesAndGapsInTheirOrder) {
  const auto log = open_frame_log(path_);
  ASSERT_TRUE(log);
  std::vector<std::int64_t> sequences;
  for (const FrameLogRow& row : log->rows) sequences.push_back(row.sequence);
  EXPECT_EQ(sequences, (std::vector<std::int64_t>{0, 2, 3, 4, 6}));
  EXPECT_EQ(log->rows[2].fault, FrameFault::kUnpaired);
  EXPECT_EQ(log->rows[3].fault, FrameFault::kNone);
  EXPECT_EQ(log->rows[3].stamp, test::tiny_stamp(2));
}

TEST_F(FrameLogFile, HasTheSameBytesWhenWrittenAgain) {
  const std::string again = folder_ / "again.lcmlog";
  write_tiny_frame_log(again);
  EXPECT_EQ(read_text(again), content_);
}

// Tools of LCM read it: liblcm's own reader finds the same events and their decoders the same
// pixels.
TEST_F(FrameLogFile, IsALogOfLcm) {
  lcm::LogFile file(path_, "r");
  ASSERT_TRUE(file.good());
  std::vector<std::string> channels;
  frame_t frame = {};
  while (const lcm::LogEvent* event = file.readNextEvent()) {
    channels.push_back(event->channel);
    EXPECT_EQ(event->eventnum, static_cast<std::int64_t>(channels.size()) - 1);
    if (event->channel != kFrameChannel) continue;
    ASSERT_EQ(frame.decode(event->data, 0, event->datalen), event->datalen);
    EXPECT_EQ(event->timestamp, frame.stamp_ns / 1000);
  }
  EXPECT_EQ(channels,
            (std::vector<std::string>{kRigChannel, kTruthChannel, kFrameChannel, kFrameChannel,
                                      kGapChannel, kFrameChannel, kFrameChannel}));
  EXPECT_EQ(frame.seq, 6);
  EXPECT_EQ(frame.right[7], test::tiny_pixel(3, true, 1, 1));
}

TEST_F(FrameLogFile, IsReadUpToTheTearWhereverItIs) {
  for (std::size_t size = 1; size < content_.size(); ++size) {
    const auto log = open_with(content_.substr(0, size));
    std::size_t whole = 0;  // events
    while (starts_[whole + 1] <= size) ++whole;
    if (whole == 0) {
      ASSERT_FALSE(log) << size;
      EXPECT_EQ(log.error().code, ExitCode::kBadInput);
      continue;
    }
    ASSERT_TRUE(log) << size << ": " << log.error().message;
    EXPECT_EQ(log->rows.size(), whole < 2 ? 0 : whole - 2) << size;
    EXPECT_EQ(log->truth.has_value(), whole >= 2) << size;
    EXPECT_EQ(log->events.torn_bytes(), static_cast<std::int64_t>(size - starts_[whole])) << size;
    EXPECT_EQ(describe_damage(*log).empty(), size == starts_[whole]) << size;
  }
}

TEST_F(FrameLogFile, LosesOneRowAtMostToAFlippedBit) {
  for (std::size_t at = starts_[2]; at < content_.size(); ++at) {
    std::string damaged = content_;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    const auto log = open_with(damaged);
    ASSERT_TRUE(log) << at;
    EXPECT_GE(log->rows.size(), 4u) << at;
    EXPECT_LE(log->rows.size(), 5u) << at;
    if (at < starts_[6]) {
      EXPECT_EQ(log->rows.back().sequence, 6) << at;
    }
  }
}

TEST_F(FrameLogFile, IsRefusedWithADamagedRig) {
  std::string damaged = content_;
  damaged[starts_[1] - 30] ^= 1;
  EXPECT_EQ(refusal(damaged).code, ExitCode::kBadInput);
  EXPECT_NE(refusal(damaged).message.find("rig is damaged"), std::string::npos);
}

TEST_F(FrameLogFile, IsNotMadeOfAnythingElse) {
  EXPECT_EQ(refusal("").code, ExitCode::kNoInput);
  EXPECT_NE(refusal("").message.find("is empty"), std::string::npos);
  EXPECT_EQ(refusal("\x89PNG\r\n and so on").code, ExitCode::kBadInput);
  EXPECT_EQ(open_frame_log(folder_.path()).error().code, ExitCode::kBadInput);
  EXPECT_EQ(open_frame_log(folder_ / "absent").error().code, ExitCode::kNoInput);
  const std::string frames_only = content_.substr(starts_[2]);
  EXPECT_EQ(refusal(frames_only).code, ExitCode::kBadInput);
  EXPECT_NE(refusal(frames_only).message.find("DARKLING_RIG"), std::string::npos);
}

TEST_F(FrameLogFile, BelievesNoLengthBeyondItsEnd) {
  for (const std::size_t field : {20, 24}) {  // of the channel, of the data
    for (const char* length : {"\x7f\xff\xff\xff", "\xff\xff\xff\xff", "\x80\x00\x00\x00"}) {
      std::string damaged = content_;
      damaged.replace(starts_[3] + field, 4, std::string(length, 4));
      const auto log = open_with(damaged);
      ASSERT_TRUE(log);
      EXPECT_EQ(log->rows.size(), 4u);
      EXPECT_EQ(log->events.damaged_bytes(), static_cast<std::int64_t>(starts_[4] - starts_[3]));
      EXPECT_EQ(log->events.torn_bytes(), 0);
    }
  }
}

}  // namespace
}  // namespace darkling
