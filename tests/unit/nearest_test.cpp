// SPDX-License-Identifier: Apache-2.0
#include "base/nearest.h"

#include <array>

#include <gtest/gtest.h>

namespace darkling::test {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"width", "stride", "frames"};

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("width", "width"), 0);
  EXPECT_EQ(edit_distance("", "width"), 5);
  EXPECT_EQ(edit_distance("wdth", "width"), 1);
  EXPECT_EQ(edit_distance("widtth", "width"), 1);
  EXPECT_EQ(edit_distance("wodth", "width"), 1);
  EXPECT_EQ(edit_distance("wdith", "width"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(NearestName, FindsTheNameThatWasMeant) {
  EXPECT_EQ(nearest_name("widht", kNames), "width");
  EXPECT_EQ(nearest_name("frame", kNames), "frames");
}

TEST(NearestName, FindsNothingForAWordLikeNone) {
  EXPECT_FALSE(nearest_name("xyzzy", kNames));
  EXPECT_FALSE(nearest_name("width", {}));
}

TEST(DidYouMean, NamesTheNearestOrAll) {
  EXPECT_EQ(did_you_mean("widht", kNames), ", did you mean 'width'?");
  EXPECT_EQ(did_you_mean("xyzzy", kNames), "; known are width, stride, frames");
  EXPECT_EQ(did_you_mean("xyzzy", {}), "");
}

}  // namespace
}  // namespace darkling::test
