// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/synthetic_spec.h"

#include <gmock/gmock.h>

namespace darkling {
namespace {

using ::testing::HasSubstr;

std::string refusal(std::string_view text) {
  const auto spec = parse_synthetic(text);
  if (spec) return "accepted";
  EXPECT_EQ(spec.error().code, ExitCode::kUsage);
  return spec.error().message;
}

TEST(ParseSynthetic, ReadsTheSceneAndItsKeys) {
  const auto spec = parse_synthetic("synthetic:quarry,frames=7,seed=42,width=160,gain=2.5,blur=0");
  ASSERT_TRUE(spec.has_value()) << spec.error().message;
  EXPECT_EQ(spec->scene, "quarry");
  EXPECT_EQ(spec->frames, 7);
  EXPECT_EQ(spec->seed, 42u);
  EXPECT_EQ(spec->width, 160);
  EXPECT_EQ(spec->gain, 2.5);
  EXPECT_FALSE(spec->blur);
}

TEST(ParseSynthetic, DerivesTheHeightUnlessItIsGiven) {
  EXPECT_EQ(parse_synthetic("synthetic:mine")->height, 240);
  EXPECT_EQ(parse_synthetic("synthetic:mine,width=100")->height, 75);
  EXPECT_EQ(parse_synthetic("synthetic:mine,width=100,height=60")->height, 60);
}

TEST(ParseSynthetic, NamesTheKnownScenesForAnUnknownOne) {
  EXPECT_THAT(refusal("synthetic:cave"), HasSubstr("\"cave\"; known are mine, quarry, corridor"));
  EXPECT_THAT(refusal("synthetic:"), HasSubstr("known are mine"));
}

TEST(ParseSynthetic, SuggestsTheNearestSceneAndKey) {
  EXPECT_THAT(refusal("synthetic:mne"), HasSubstr("\"mne\", did you mean 'mine'?"));
  EXPECT_THAT(refusal("synthetic:mine,frmes=3"), HasSubstr("\"frmes\", did you mean 'frames'?"));
}

TEST(ParseSynthetic, NamesTheKnownKeysForAnUnknownOne) {
  EXPECT_THAT(refusal("synthetic:mine,fps=3"), HasSubstr("\"fps\"; known are frames, seed"));
}

TEST(ParseSynthetic, SaysTheRangeForAValueOutsideIt) {
  EXPECT_THAT(refusal("synthetic:mine,frames=0"), HasSubstr("a whole number from 1 to 5000"));
  EXPECT_THAT(refusal("synthetic:mine,width=4000"), HasSubstr("from 64 to 1920"));
  EXPECT_THAT(refusal("synthetic:mine,gain=-1"), HasSubstr("a number from 0.01 to 100"));
  EXPECT_THAT(refusal("synthetic:mine,width=640,height=48"), HasSubstr("a quarter"));
}

TEST(ParseSynthetic, RefusesWhatIsNoNumber) {
  EXPECT_THAT(refusal("synthetic:mine,frames=ten"), HasSubstr("\"ten\" is not a whole number"));
  EXPECT_THAT(refusal("synthetic:mine,frames=2.5"), HasSubstr("is not a whole number"));
  EXPECT_THAT(refusal("synthetic:mine,gain=nan"), HasSubstr("is not a number"));
  EXPECT_THAT(refusal("synthetic:mine,gain="), HasSubstr("is not a number"));
  EXPECT_THAT(refusal("synthetic:mine,"), HasSubstr("is not key=value"));
  EXPECT_THAT(refusal("mine"), HasSubstr("not a synthetic source"));
}

}  // namespace
}  // namespace darkling
