// SPDX-License-Identifier: Apache-2.0
#include "drivers/dataset/dataset_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

const TinyDataset kTiny{.frames = 5};
const ImageSize kTinySize{kTiny.width, kTiny.height};

class DatasetSourceTest : public ::testing::Test {
 protected:
  void SetUp() override { write_tiny_kitti(folder_.path(), kTiny); }

  std::vector<DatasetRow> rows() { return list_kitti_rows(folder_.path()).value(); }
  std::string left(int frame) { return folder_ / "image_0/" + kitti_image_name(frame); }
  std::string right(int frame) { return folder_ / "image_1/" + kitti_image_name(frame); }

  // What every pair of the source was: kNone for those delivered.
  static std::vector<FrameFault> play(FrameSource& source) {
    std::vector<FrameFault> faults;
    EXPECT_TRUE(source.start());
    for (;;) {
      const WaitResult result = source.wait_next(Duration{0});
      if (result.status == WaitStatus::kEndOfSource) return faults;
      const bool is_frame = result.status == WaitStatus::kFrame;
      const auto position = static_cast<std::int64_t>(faults.size());
      EXPECT_EQ(is_frame ? result.lease.frame().sequence : result.sequence, position);
      EXPECT_EQ(is_frame, result.fault == FrameFault::kNone);
      faults.push_back(result.fault);
    }
  }

  // Plays all five frames and expects that the third alone has `fault`.
  SourceStats play_with_third(FrameFault fault) {
    DatasetSource source(rows(), kTinySize);
    using enum FrameFault;
    EXPECT_THAT(play(source), ::testing::ElementsAre(kNone, kNone, fault, kNone, kNone));
    return source.stats();
  }

  TemporaryFolder folder_;
};

TEST_F(DatasetSourceTest, DeliversEveryPairWithItsPixels) {
  DatasetSource source(rows(), kTinySize);
  ASSERT_TRUE(source.start());
  for (int k = 0; k < kTiny.frames; ++k) {
    const WaitResult result = source.wait_next(Duration{0});
    ASSERT_EQ(result.status, WaitStatus::kFrame);
    const StereoFrame& frame = result.lease.frame();
    EXPECT_EQ(frame.sequence, k);
    EXPECT_EQ(to_ns(frame.stamp), k * 100'000'000LL);
    EXPECT_EQ(frame.left.at(7, 3), tiny_image(kTiny, k, false).pixels[3 * kTiny.width + 7]);
    EXPECT_EQ(frame.right.at(7, 3), tiny_image(kTiny, k, true).pixels[3 * kTiny.width + 7]);
  }
  EXPECT_EQ(source.wait_next(Duration{0}).status, WaitStatus::kEndOfSource);
  EXPECT_EQ(source.wait_next(Duration{0}).status, WaitStatus::kEndOfSource);
  EXPECT_EQ(source.stats().delivered, kTiny.frames);
}

TEST_F(DatasetSourceTest, PlaysFromTheBeginningWhenStartedAgain) {
  DatasetSource source(rows(), kTinySize);
  EXPECT_EQ(play(source).size(), 5u);
  source.stop();
  EXPECT_EQ(play(source).size(), 5u);
  EXPECT_EQ(source.stats().delivered, 5);
}

TEST_F(DatasetSourceTest, CountsATruncatedImageAndGoesOn) {
  truncate_file(left(2), 0.5);
  EXPECT_EQ(play_with_third(FrameFault::kUnreadable).unreadable, 1);
}

TEST_F(DatasetSourceTest, CountsACorruptImageAndGoesOn) {
  flip_middle_byte(right(2));
  const SourceStats stats = play_with_third(FrameFault::kUnreadable);
  EXPECT_EQ(stats.unreadable, 1);
  EXPECT_EQ(stats.delivered, 4);
}

TEST_F(DatasetSourceTest, CountsAnEmptyImageAndGoesOn) {
  write_text(left(2), "");
  EXPECT_EQ(play_with_third(FrameFault::kUnreadable).unreadable, 1);
}

TEST_F(DatasetSourceTest, CountsAPairMissingInBothEyesAndGoesOn) {
  remove_path(left(2));
  remove_path(right(2));
  EXPECT_EQ(play_with_third(FrameFault::kUnreadable).unreadable, 1);
}

TEST_F(DatasetSourceTest, CountsAnImageOfAnotherSizeAndGoesOn) {
  write_image(right(2), tiny_image({.width = 80, .height = 60}, 0, true));
  EXPECT_EQ(play_with_third(FrameFault::kWrongSize).wrong_size, 1);
}

TEST_F(DatasetSourceTest, CountsAPairWithoutOneEyeInItsPlace) {
  auto broken = rows();
  broken[2].right_path.clear();
  DatasetSource source(broken, kTinySize);
  using enum FrameFault;
  EXPECT_THAT(play(source), ::testing::ElementsAre(kNone, kNone, kUnpaired, kNone, kNone));
  EXPECT_EQ(source.stats().unpaired, 1);
}

TEST_F(DatasetSourceTest, DeliversAndCountsStampsThatRepeatOrGoBack) {
  write_text(folder_ / "times.txt", "0\n0.2\n0.2\n0.1\n0.4\n");
  const SourceStats stats = play_with_third(FrameFault::kNone);
  EXPECT_EQ(stats.delivered, 5);
  EXPECT_EQ(stats.stamps_not_increasing, 2);
}

TEST_F(DatasetSourceTest, KeepsLeasedPixelsWhileOthersAreRead) {
  DatasetSource source(rows(), kTinySize);
  ASSERT_TRUE(source.start());
  const WaitResult first = source.wait_next(Duration{0});
  const std::uint8_t before = first.lease.frame().left.at(7, 3);
  for (int k = 1; k < kTiny.frames; ++k) {
    ASSERT_EQ(source.wait_next(Duration{0}).status, WaitStatus::kFrame);
  }
  EXPECT_EQ(first.lease.frame().left.at(7, 3), before);
}

TEST_F(DatasetSourceTest, TimesOutWhileAllBuffersAreOnLoanAndLosesNoFrame) {
  DatasetSource source(rows(), kTinySize);
  ASSERT_TRUE(source.start());
  std::vector<WaitResult> held;
  for (int k = 0; k < DatasetSource::kSlotCount; ++k) held.push_back(source.wait_next(Duration{0}));
  EXPECT_EQ(source.wait_next(Duration{0}).status, WaitStatus::kTimeout);
  held.clear();
  const WaitResult next = source.wait_next(Duration{0});
  ASSERT_EQ(next.status, WaitStatus::kFrame);
  EXPECT_EQ(next.lease.frame().sequence, DatasetSource::kSlotCount);
}

TEST_F(DatasetSourceTest, FindsTheSizeInTheFirstPairThatCanBeRead) {
  truncate_file(left(0), 0.5);
  const auto size = first_pair_size(rows());
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(*size, kTinySize);
}

TEST_F(DatasetSourceTest, FindsNoSizeWhenTheEyesDiffer) {
  write_image(right(0), tiny_image({.width = 80, .height = 60}, 0, true));
  const auto size = first_pair_size(rows());
  ASSERT_FALSE(size.has_value());
  EXPECT_EQ(size.error().code, ExitCode::kBadInput);
  EXPECT_THAT(size.error().message, ::testing::HasSubstr("96x64"));
  EXPECT_THAT(size.error().message, ::testing::HasSubstr("80x60"));
}

TEST_F(DatasetSourceTest, FindsNoSizeWhenNothingCanBeRead) {
  for (int k = 0; k < kTiny.frames; ++k) truncate_file(left(k), 0.5);
  const auto size = first_pair_size(rows());
  ASSERT_FALSE(size.has_value());
  EXPECT_EQ(size.error().code, ExitCode::kNoInput);
}

}  // namespace
}  // namespace darkling::test
