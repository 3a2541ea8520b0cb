// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/top/page.h"

namespace darkling {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(TopPage, CountsCharactersNotBytes) {
  EXPECT_EQ(columns_of("abc"), 3);
  EXPECT_EQ(columns_of("├─┤"), 3);
  EXPECT_EQ(columns_of(Row{{"ab"}, {"█░"}}), 4);
}

TEST(TopPage, ClipsBetweenCharactersOfSeveralBytes) {
  const Row row = {{"a├"}, {"─┤", Tone::kGood}, {"rest"}};
  EXPECT_EQ(plain_text(clip(row, 3)), "a├─");
  EXPECT_EQ(plain_text(clip(row, 4)), "a├─┤");
  EXPECT_EQ(plain_text(clip(row, 100)), "a├─┤rest");
  EXPECT_EQ(plain_text(clip(row, 0)), "");
}

TEST(TopPage, PadsToAWidthAndNeverCuts) {
  EXPECT_EQ(columns_of(pad({{"─"}}, 10)), 10);
  EXPECT_EQ(columns_of(pad({{"twelve chars"}}, 10)), 12);
}

TEST(TopPage, LetsNothingFromTheNetworkSteerTheTerminal) {
  EXPECT_EQ(printable("cam\033[2J\n\x7f\xc3"), "cam?[2J???");
}

TEST(TopPage, IsPlainWithoutColours) {
  EXPECT_EQ(plain_text(Page{{{"a", Tone::kBad, true}, {"  "}}, {}, {{"b"}}}), "a\n\nb\n");
}

TEST(TopPage, DrawsNoMoreThanFitsIntoTheTerminal) {
  const Page page = {{{"first line", Tone::kBad}}, {{"second"}}, {{"third"}}};
  EXPECT_THAT(painted(page, 5, 2), AllOf(HasSubstr("\033[31mfirst\033[0m"), HasSubstr("secon"),
                                         Not(HasSubstr("secondt")), Not(HasSubstr("third"))));
}

}  // namespace
}  // namespace darkling
