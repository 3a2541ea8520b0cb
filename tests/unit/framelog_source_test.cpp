// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/framelog_source.h"

#include <csignal>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "drivers/framelog/rig_record.h"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"

namespace darkling {
namespace {

using test::event_starts;
using test::read_text;
using test::TemporaryFolder;
using test::write_text;
using test::write_tiny_frame_log;

FramelogSource make_source(const std::string& path) {
  auto log = open_frame_log(path);
  if (!log) throw std::runtime_error(log.error().message);
  return FramelogSource(std::move(log->events), std::move(log->rows));
}

void expect_tiny_frame(const StereoFrame& frame, int index) {
  EXPECT_EQ(frame.sequence, 2 * index);
  EXPECT_EQ(frame.stamp, test::tiny_stamp(index));
  ASSERT_TRUE(frame.left.has_size(test::kTinyWidth, test::kTinyHeight));
  ASSERT_TRUE(frame.right.has_size(test::kTinyWidth, test::kTinyHeight));
  for (int y = 0; y < test::kTinyHeight; ++y) {
    for (int x = 0; x < test::kTinyWidth; ++x) {
      ASSERT_EQ(frame.left.at(x, y), test::tiny_pixel(index, false, x, y));
      ASSERT_EQ(frame.right.at(x, y), test::tiny_pixel(index, true, x, y));
    }
  }
}

TEST(FramelogSource, PlaysWhatWasWritten) {
  const TemporaryFolder folder;
  write_tiny_frame_log(folder / "run.lcmlog");
  FramelogSource source = make_source(folder / "run.lcmlog");
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(source.start());
    for (int k = 0; k < test::kTinyFrames; ++k) {
      if (k == 2) {
        const WaitResult gap = source.wait_next({});
        EXPECT_EQ(gap.status, WaitStatus::kBadFrame);
        EXPECT_EQ(gap.fault, FrameFault::kUnpaired);
        EXPECT_EQ(gap.sequence, 3);
      }
      const WaitResult next = source.wait_next({});
      ASSERT_EQ(next.status, WaitStatus::kFrame);
      expect_tiny_frame(next.lease.frame(), k);
    }
    EXPECT_EQ(source.wait_next({}).status, WaitStatus::kEndOfSource);
    EXPECT_EQ(source.stats().delivered, 4);
    EXPECT_EQ(source.stats().unpaired, 1);
    source.stop();
  }
}

TEST(FramelogSource, WaitsWhileEveryBufferIsOnLoan) {
  const TemporaryFolder folder;
  write_tiny_frame_log(folder / "run.lcmlog");
  FramelogSource source = make_source(folder / "run.lcmlog");
  ASSERT_TRUE(source.start());
  WaitResult first = source.wait_next({});
  WaitResult second = source.wait_next({});
  (void)source.wait_next({});  // the gap
  WaitResult third = source.wait_next({});
  EXPECT_EQ(source.wait_next({}).status, WaitStatus::kTimeout);
  expect_tiny_frame(first.lease.frame(), 0);
  expect_tiny_frame(third.lease.frame(), 2);
  second.lease = {};
  const WaitResult fourth = source.wait_next({});
  ASSERT_EQ(fourth.status, WaitStatus::kFrame);
  expect_tiny_frame(fourth.lease.frame(), 3);
}

TEST(FramelogSource, GivesNoPixelThatWasFlipped) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  write_tiny_frame_log(path);
  const std::string content = read_text(path);
  const std::vector<std::size_t> starts = event_starts(content);
  for (std::size_t at = starts[3]; at < starts[4]; ++at) {  // the second frame
    std::string damaged = content;
    damaged[at] ^= 0x10;
    write_text(path, damaged);
    FramelogSource source = make_source(path);
    ASSERT_TRUE(source.start());
    for (WaitResult next = source.wait_next({}); next.status != WaitStatus::kEndOfSource;
         next = source.wait_next({})) {
      if (next.status != WaitStatus::kFrame) continue;
      expect_tiny_frame(next.lease.frame(), static_cast<int>(next.lease.frame().sequence / 2));
    }
    // The number and the stamp of the event are LCM's: nothing of ours goes with them.
    const bool is_header = at - starts[3] >= 4 && at - starts[3] < 20;
    EXPECT_EQ(source.stats().delivered, is_header ? 4 : 3) << at - starts[3];
  }
}

TEST(FrameLogWriter, LeavesAWholeLogWhenItIsFull) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  auto writer = FrameLogWriter::create(path, to_rig_record(test::tiny_log_rig()), 1000);
  ASSERT_TRUE(writer);
  const std::vector<std::uint8_t> pixels(24);
  const ImageView<const std::uint8_t> image(pixels.data(), 6, 4, 6);
  int written = 0;
  Result<void> added;
  while ((added = writer->add_frame({written, FrameTime{}, image, image}))) ++written;
  EXPECT_EQ(added.error().code, ExitCode::kUsage);
  EXPECT_NE(added.error().message.find("1000 bytes"), std::string::npos);
  EXPECT_FALSE(writer->add_gap(99, {}, FrameFault::kUnreadable));
  EXPECT_FALSE(writer->close());
  EXPECT_LE(read_text(path).size(), 1000u);
  EXPECT_EQ(static_cast<std::int64_t>(read_text(path).size()), writer->byte_count());
  const auto log = open_frame_log(path);
  ASSERT_TRUE(log);
  EXPECT_EQ(static_cast<int>(log->rows.size()), written);
  EXPECT_EQ(describe_damage(*log), "");
}

// The limit on a file's size stands for a disk that is full in the middle of a record.
TEST(FrameLogWriter, LeavesAWholeLogWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.lcmlog";
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  auto writer = FrameLogWriter::create(path, to_rig_record(test::tiny_log_rig()));
  ASSERT_TRUE(writer);
  test::add_tiny_frame(*writer, 0);
  rlimit lower = before;
  lower.rlim_cur = static_cast<rlim_t>(writer->byte_count() + 90);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &lower), 0);
  EXPECT_ANY_THROW(test::add_tiny_frame(*writer, 1));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_ANY_THROW(test::add_tiny_frame(*writer, 1));
  EXPECT_FALSE(writer->close());
  const auto log = open_frame_log(path);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->rows.size(), 1u);
  EXPECT_EQ(describe_damage(*log), "");
}

TEST(FrameLogWriter, SaysWhyItCannotWrite) {
  const TemporaryFolder folder;
  const auto refused = FrameLogWriter::create(folder / "no/run.lcmlog", rig_t{});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ExitCode::kUsage);
  EXPECT_NE(refused.error().message.find("No such file"), std::string::npos);
}

TEST(RigRecord, IsRefusedWhenItCannotBe) {
  const auto refused = [](auto change) {
    rig_t record = to_rig_record(test::tiny_log_rig());
    change(record);
    const auto rig = from_rig_record(record);
    return !rig && rig.error().code == ExitCode::kBadInput;
  };
  EXPECT_FALSE(refused([](rig_t&) {}));
  EXPECT_TRUE(refused([](rig_t& r) { r.layout = 2; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.model[1] = rig_t::MODEL_UNKNOWN; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.width[0] = r.width[1] = 1 << 30; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.height[0] = r.height[1] = 0; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.width[1] += 1; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.rotation[0][0] += 0.1; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.rotation[1][2] = 0.0 / 0.0; }));
  EXPECT_TRUE(refused([](rig_t& r) { r.translation[1][2] = 1.0 / 0.0; }));
}

}  // namespace
}  // namespace darkling
