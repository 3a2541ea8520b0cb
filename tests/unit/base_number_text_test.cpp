// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <gtest/gtest.h>

#include "base/number_text.h"

namespace darkling {
namespace {

TEST(NumberText, WritesSixSignificantDigitsWithoutTrailingZeros) {
  EXPECT_EQ(number_text(0.11), "0.11");
  EXPECT_EQ(number_text(-3.0), "-3");
  EXPECT_EQ(number_text(458.6541234), "458.654");
  EXPECT_EQ(number_text(1e-9), "1e-09");
}

TEST(NumberText, FitsTheLongestNumbers) {
  EXPECT_EQ(number_text(-std::numeric_limits<double>::max()), "-1.79769e+308");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "inf");
}

}  // namespace
}  // namespace darkling
