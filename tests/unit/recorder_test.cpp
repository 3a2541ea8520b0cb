// SPDX-License-Identifier: Apache-2.0
#include "app/service/recorder.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/service/wish_messages.h"
#include "drivers/framelog/frame_log.h"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"

namespace darkling {
namespace {

using ::testing::ElementsAre;

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    config_.service.record_to = folder_.path();
    config_.service.record = true;
  }

  [[nodiscard]] Recorder start() const { return {config_, test::tiny_log_rig(), "tiny"}; }
  [[nodiscard]] std::vector<std::string> logs() const {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      paths.push_back(entry.path());
    }
    return paths;
  }
  static void record_gap(Recorder& recorder, std::int64_t sequence) {
    recorder.on_pair({.status = WaitStatus::kBadFrame,
                      .fault = FrameFault::kUnreadable,
                      .sequence = sequence,
                      .stamp = test::tiny_stamp(0)},
                     {});
  }

  test::TemporaryFolder folder_;
  Config config_;
};

Wish hint(double x_m) {
  return {.kind = Wish::Kind::kHint,
          .T_previous_body = Se3::exp((Vector6() << x_m, 0.1, 0.2, 0.3, 0.4, 0.5).finished()),
          .span = std::chrono::milliseconds(50)};
}

TEST_F(RecorderTest, WritesOverNoRecordingOfTheSameSecond) {
  constexpr std::size_t kRecordings = 4;  // at once: three of them share a second at least
  for (std::size_t i = 0; i < kRecordings; ++i) {
    Recorder recorder = start();
    record_gap(recorder, static_cast<std::int64_t>(i));
    recorder.stop();
    EXPECT_EQ(recorder.failures(), 0);
  }
  const std::vector<std::string> paths = logs();
  ASSERT_EQ(paths.size(), kRecordings);
  std::int64_t sum = 0;
  for (const std::string& path : paths) {
    const auto log = open_frame_log(path);
    ASSERT_TRUE(log) << log.error().message;
    ASSERT_EQ(log->rows.size(), 1U);
    sum += log->rows[0].sequence;
  }
  EXPECT_EQ(sum, 0 + 1 + 2 + 3);
}

TEST_F(RecorderTest, KeepsWishesBeforeTheirPairToTheBit) {
  Recorder recorder = start();
  record_gap(recorder, 3);
  for (int i = 0; i < 40; ++i) recorder.on_wish(hint(0.1 * i));  // a fast sensor
  recorder.on_wish({.kind = Wish::Kind::kReset});
  recorder.on_wish({.kind = Wish::Kind::kReset});
  recorder.on_wish({.kind = Wish::Kind::kReseed});
  recorder.on_wish({.kind = Wish::Kind::kReseed});
  record_gap(recorder, 5);
  record_gap(recorder, 6);
  recorder.stop();
  EXPECT_EQ(recorder.drops(), 0);
  const auto log = open_frame_log(logs().front());
  ASSERT_TRUE(log) << log.error().message;
  const RecordedWishes recorded = read_wishes(*log);
  EXPECT_EQ(recorded.unreadable, 0);
  std::vector<Wish::Kind> kinds;
  for (const RecordedWish& wish : recorded.wishes) {
    EXPECT_EQ(wish.sequence, 5);
    kinds.push_back(wish.wish.kind);
  }
  ASSERT_THAT(kinds, ElementsAre(Wish::Kind::kHint, Wish::Kind::kReset, Wish::Kind::kReset,
                                 Wish::Kind::kReseed));
  const Se3 T_back = recorded.wishes[0].wish.T_previous_body;
  const Se3 T_last = hint(0.1 * 39).T_previous_body;
  EXPECT_EQ(T_back.translation(), T_last.translation());
  EXPECT_EQ(T_back.rotation().coeffs(), T_last.rotation().coeffs());
}

TEST_F(RecorderTest, CountsWishesThatItHasNoRoomFor) {
  Recorder recorder = start();
  for (std::size_t i = 0; i < kWishRingSize + 3; ++i)
    recorder.on_wish({.kind = Wish::Kind::kReset});
  EXPECT_EQ(recorder.drops(), 3);
}

}  // namespace
}  // namespace darkling
