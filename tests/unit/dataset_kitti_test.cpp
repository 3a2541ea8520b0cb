// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/dataset/dataset_rows.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

class KittiRows : public ::testing::Test {
 protected:
  void SetUp() override { write_tiny_kitti(folder_.path(), {.frames = 5}); }

  void remove_pair(int frame) {
    remove_path(folder_ / "image_0/" + kitti_image_name(frame));
    remove_path(folder_ / "image_1/" + kitti_image_name(frame));
  }

  void expect_refused(ExitCode code, std::initializer_list<std::string> words) {
    const auto rows = list_kitti_rows(folder_.path());
    ASSERT_FALSE(rows.has_value());
    EXPECT_EQ(rows.error().code, code);
    for (const std::string& word : words) EXPECT_THAT(rows.error().message, HasSubstr(word));
  }

  TemporaryFolder folder_;
};

TEST_F(KittiRows, PairImagesAndTimesInTheirOrder) {
  const auto rows = list_kitti_rows(folder_.path());
  ASSERT_TRUE(rows) << rows.error().message;
  ASSERT_EQ(rows->size(), 5u);
  EXPECT_EQ((*rows)[3].sequence, 3);
  EXPECT_EQ(to_ns((*rows)[3].stamp), 300'000'000);
  EXPECT_EQ((*rows)[3].left_path, folder_ / "image_0/000003.png");
  EXPECT_EQ((*rows)[3].right_path, folder_ / "image_1/000003.png");
}

TEST_F(KittiRows, ReadTimesInScientificNotationAndWindowsLineEnds) {
  write_text(folder_ / "times.txt", "0.000000e+00\r\n1.0e-01\r\n2e-1\r\n0.3\r\n0.4\r\n\r\n");
  const auto rows = list_kitti_rows(folder_.path());
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(to_ns((*rows)[1].stamp), 100'000'000);
}

TEST_F(KittiRows, FollowTheNumbersInNamesWhereImagesAreFewerThanTimes) {
  remove_pair(0);
  remove_pair(4);
  const auto rows = list_kitti_rows(folder_.path());
  ASSERT_TRUE(rows) << rows.error().message;
  ASSERT_EQ(rows->size(), 3u);
  EXPECT_EQ(rows->front().sequence, 1);
  EXPECT_EQ(to_ns(rows->front().stamp), 100'000'000);
}

TEST_F(KittiRows, KeepThePlaceOfAPairThatIsMissingInBothEyes) {
  remove_pair(2);
  const auto rows = list_kitti_rows(folder_.path());
  ASSERT_TRUE(rows) << rows.error().message;
  ASSERT_EQ(rows->size(), 5u);
  EXPECT_EQ((*rows)[2].sequence, 2);
  EXPECT_EQ((*rows)[3].left_path, folder_ / "image_0/000003.png");
}

TEST_F(KittiRows, AreRefusedWhenTheEyesHoldDifferentCounts) {
  remove_path(folder_ / "image_1/000004.png");
  expect_refused(ExitCode::kBadInput, {"5 images", "image_1 4", "000004.png is only in image_0"});
}

TEST_F(KittiRows, AreRefusedWhenTheEyesHoldDifferentNames) {
  remove_path(folder_ / "image_0/000001.png");
  remove_path(folder_ / "image_1/000003.png");
  expect_refused(ExitCode::kBadInput, {"000001.png is only in image_1"});
}

TEST_F(KittiRows, AreRefusedWithoutTimes) {
  remove_path(folder_ / "times.txt");
  expect_refused(ExitCode::kNoInput, {"times.txt", "No such file"});
}

TEST_F(KittiRows, AreRefusedWithFewerTimesThanImages) {
  write_text(folder_ / "times.txt", "0\n0.1\n0.2\n");
  expect_refused(ExitCode::kBadInput, {"3 lines", "5 pairs"});
}

TEST_F(KittiRows, AreRefusedWithATimeThatIsNoNumber) {
  for (const char* time : {"soon", "nan", "1e300", "0.2 0.3"}) {
    write_text(folder_ / "times.txt", std::string("0\n") + time + "\n0.2\n0.3\n0.4\n");
    expect_refused(ExitCode::kBadInput, {"times.txt:2:", time});
  }
}

TEST_F(KittiRows, AreRefusedWithoutImages) {
  for (int k = 0; k < 5; ++k) remove_path(folder_ / "image_1/" + kitti_image_name(k));
  expect_refused(ExitCode::kNoInput, {"image_1", "holds no"});
}

TEST(SelectRows, TakesEveryNthOfARange) {
  std::vector<DatasetRow> rows(10);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].sequence = static_cast<std::int64_t>(i);
  const auto selected = select_rows(rows, {.first = 2, .last = 9, .stride = 3});
  ASSERT_EQ(selected.size(), 3u);
  EXPECT_EQ(selected[0].sequence, 2);
  EXPECT_EQ(selected[1].sequence, 5);
  EXPECT_EQ(selected[2].sequence, 8);
}

TEST(SelectRows, TakesAllByDefaultAndNoneBeyondTheEnd) {
  const std::vector<DatasetRow> rows(10);
  EXPECT_EQ(select_rows(rows, {}).size(), 10u);
  EXPECT_EQ(select_rows(rows, {.first = 10}).size(), 0u);
  EXPECT_EQ(select_rows(rows, {.first = 9, .last = 100}).size(), 1u);
}

TEST(SelectRows, SurvivesTheLargestStride) {
  const std::vector<DatasetRow> rows(10);
  EXPECT_EQ(select_rows(rows, {.stride = std::numeric_limits<std::int64_t>::max()}).size(), 1u);
}

}  // namespace
}  // namespace darkling::test
