// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "io/decimal_time.h"

namespace darkling {
namespace {

TEST(NsFromSecondsText, KeepsEveryNanosecondOfAnEpochStamp) {
  EXPECT_EQ(ns_from_seconds_text("1403636584.763555584"), 1403636584763555584);
  EXPECT_EQ(ns_from_seconds_text("1403636584.66356"), 1403636584663560000);
  EXPECT_EQ(ns_from_seconds_text("1403636584"), 1403636584000000000);
}

TEST(NsFromSecondsText, ReadsSignsExponentsAndBareFractions) {
  EXPECT_EQ(ns_from_seconds_text("-0.5"), -500000000);
  EXPECT_EQ(ns_from_seconds_text("+2.25"), 2250000000);
  EXPECT_EQ(ns_from_seconds_text(".000000001"), 1);
  EXPECT_EQ(ns_from_seconds_text("3."), 3000000000);
  EXPECT_EQ(ns_from_seconds_text("1.40363658466356e+09"), 1403636584663560000);
  EXPECT_EQ(ns_from_seconds_text("25e-4"), 2500000);
}

TEST(NsFromSecondsText, RoundsBeyondTheNinthDecimal) {
  EXPECT_EQ(ns_from_seconds_text("0.0000000014"), 1);
  EXPECT_EQ(ns_from_seconds_text("0.0000000015"), 2);
  EXPECT_EQ(ns_from_seconds_text("0.9999999999"), 1000000000);
  EXPECT_EQ(ns_from_seconds_text("6e-10"), 1);
  EXPECT_EQ(ns_from_seconds_text("6e-11"), 0);
}

TEST(NsFromSecondsText, RefusesWhatIsNoNumberOrDoesNotFit) {
  for (const char* text : {"", "-", ".", "1.2.3", "abc", "1,5", "0x10", "1e", "nan", "inf", "--1",
                           "9300000000", "1e30", "1e99"}) {
    EXPECT_EQ(ns_from_seconds_text(text), std::nullopt) << text;
  }
}

TEST(SecondsTextFromNs, WritesNineDecimals) {
  EXPECT_EQ(seconds_text_from_ns(0), "0.000000000");
  EXPECT_EQ(seconds_text_from_ns(1403636584763555584), "1403636584.763555584");
  EXPECT_EQ(seconds_text_from_ns(-1), "-0.000000001");
  EXPECT_EQ(seconds_text_from_ns(INT64_MIN), "-9223372036.854775808");
}

}  // namespace
}  // namespace darkling
