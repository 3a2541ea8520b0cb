// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/dataset/dataset_rows.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

// Only lists are read here: the images need not exist.
class EurocRows : public ::testing::Test {
 protected:
  void write_csv(const std::string& left, const std::string& right) {
    write_text(folder_ / "cam0/data.csv", left);
    write_text(folder_ / "cam1/data.csv", right);
  }

  std::vector<DatasetRow> list() {
    const auto rows = list_euroc_rows(folder_.path());
    EXPECT_TRUE(rows.has_value()) << rows.error().message;
    return rows.value_or(std::vector<DatasetRow>());
  }

  void expect_refused(ExitCode code, std::initializer_list<const char*> words) {
    const auto rows = list_euroc_rows(folder_.path());
    ASSERT_FALSE(rows.has_value());
    EXPECT_EQ(rows.error().code, code);
    for (const char* word : words) EXPECT_THAT(rows.error().message, HasSubstr(word));
  }

  std::string left(const char* name) { return folder_ / "cam0/data/" + name; }
  std::string right(const char* name) { return folder_ / "cam1/data/" + name; }

  TemporaryFolder folder_;
};

TEST_F(EurocRows, PairEqualStamps) {
  write_csv("#timestamp [ns],filename\n1000,a.png\n2000,b.png\n", "1000,c.png\n2000,d.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].sequence, 1);
  EXPECT_EQ(to_ns(rows[1].stamp), 2000);
  EXPECT_EQ(rows[1].left_path, left("b.png"));
  EXPECT_EQ(rows[1].right_path, right("d.png"));
}

TEST_F(EurocRows, ReadWindowsLineEndsSpacesAndAHeaderWithoutItsMark) {
  write_csv("timestamp,filename\r\n1000 , a.png\r\n", "#timestamp\r\n1000,c.png\r\n\r\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].left_path, left("a.png"));
}

TEST_F(EurocRows, PairTheNearestWithinFiveMilliseconds) {
  write_csv("0,a.png\n50000000,b.png\n100000000,e.png\n",
            "4000000,c.png\n46000000,d.png\n105000001,f.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].right_path, right("c.png"));
  EXPECT_EQ(rows[1].right_path, right("d.png"));
  EXPECT_EQ(rows[2].left_path, left("e.png"));
  EXPECT_EQ(rows[2].right_path, "");
  EXPECT_EQ(rows[3].left_path, "");
  EXPECT_EQ(rows[3].right_path, right("f.png"));
}

TEST_F(EurocRows, DoNotGiveAnEqualStampToANeighbour) {
  write_csv("998,a.png\n1000,b.png\n", "1000,c.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].right_path, "");
  EXPECT_EQ(rows[1].right_path, right("c.png"));
}

TEST_F(EurocRows, KeepLonelyImagesInTheirPlace) {
  write_csv("100000000,a.png\n300000000,b.png\n",
            "100000000,a.png\n200000000,c.png\n300000000,b.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].left_path, "");
  EXPECT_EQ(rows[1].right_path, right("c.png"));
  EXPECT_EQ(rows[2].sequence, 2);
}

TEST_F(EurocRows, PairRepeatedStampsOneByOne) {
  write_csv("1000,a.png\n1000,b.png\n2000,c.png\n", "1000,a.png\n1000,b.png\n2000,c.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].right_path, right("a.png"));
  EXPECT_EQ(rows[1].right_path, right("b.png"));
}

TEST_F(EurocRows, KeepTheListsOrderWhereStampsGoBack) {
  write_csv("100000000,a.png\n50000000,b.png\n", "100000000,a.png\n50000000,b.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].left_path, left("b.png"));
  EXPECT_EQ(to_ns(rows[1].stamp), 50000000);
}

TEST_F(EurocRows, PairByNameWhereTheStampOfOneEyeIsGarbled) {
  write_csv("100000000,a.png\n100000000,b.png\n", "100000000,a.png\n200000000,b.png\n");
  const auto rows = list();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].left_path, left("b.png"));
  EXPECT_EQ(rows[1].right_path, right("b.png"));
}

TEST_F(EurocRows, AreRefusedWithoutAList) {
  write_text(folder_ / "cam0/data.csv", "1000,a.png\n");
  expect_refused(ExitCode::kNoInput, {"cam1/data.csv", "No such file"});
}

TEST_F(EurocRows, AreRefusedWithALineThatIsNoStampAndName) {
  for (const char* line : {"1000", "1000,", "1e3,a.png", "99999999999999999999,a.png", ",a.png"}) {
    write_csv(std::string("500,z.png\n") + line + "\n", "500,z.png\n");
    expect_refused(ExitCode::kBadInput, {"cam0/data.csv:2:", line});
  }
}

TEST_F(EurocRows, AreRefusedWhenAListIsEmpty) {
  write_csv("#timestamp [ns],filename\n", "1000,a.png\n");
  expect_refused(ExitCode::kBadInput, {"cam0/data.csv", "lists no images"});
}

TEST_F(EurocRows, AreRefusedWhenNothingPairs) {
  write_csv("1000000000,a.png\n", "9000000000,b.png\n");
  expect_refused(ExitCode::kBadInput, {"none of the 1 images", "5 ms"});
}

}  // namespace
}  // namespace darkling::test
