// SPDX-License-Identifier: Apache-2.0
#include "messages/channel_pattern.h"

#include <regex>

#include <gtest/gtest.h>

namespace darkling {
namespace {

TEST(ChannelPattern, MatchesItsTextAndNothingElse) {
  for (const char* text : {"rover1/", "a.b", "(x)[y]{2}", "^$|?*+\\", ""}) {
    EXPECT_TRUE(std::regex_match(text, std::regex(escape_channel(text)))) << text;
  }
  EXPECT_FALSE(std::regex_match("axb", std::regex(escape_channel("a.b"))));
}

}  // namespace
}  // namespace darkling
