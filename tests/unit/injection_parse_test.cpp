// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/injection/injection.h"
#include "support/random.h"

namespace darkling {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(std::string_view text) {
  const auto injection = parse_injection(text);
  if (injection) return "taken";
  EXPECT_EQ(injection.error().code, ExitCode::kUsage) << text;
  return injection.error().message;
}

TEST(ParseInjection, TakesANameAndItsValue) {
  const auto injection = parse_injection("electrons=7.5");
  ASSERT_TRUE(injection.has_value()) << injection.error().message;
  EXPECT_EQ(injection->kind->name, "electrons");
  EXPECT_EQ(injection->value, 7.5);
  EXPECT_EQ(injection->seed, 1u);
  EXPECT_TRUE(injection->is_due(0));
  EXPECT_TRUE(injection->is_due(1'000'000'000'000));
}

TEST(ParseInjection, TakesARangeOfFramesWithItsEndLeftOut) {
  const auto injection = parse_injection("gain=2@3:5,seed=9");
  ASSERT_TRUE(injection.has_value()) << injection.error().message;
  EXPECT_EQ(injection->seed, 9u);
  EXPECT_FALSE(injection->is_due(2));
  EXPECT_TRUE(injection->is_due(3));
  EXPECT_TRUE(injection->is_due(4));
  EXPECT_FALSE(injection->is_due(5));
  EXPECT_TRUE(parse_injection("gain=2@3:")->is_due(1'000'000));
  EXPECT_TRUE(parse_injection("gain=2@:3")->is_due(0));
  EXPECT_FALSE(parse_injection("gain=2@:3")->is_due(3));
}

TEST(ParseInjection, SuggestsTheNameThatWasMeant) {
  EXPECT_THAT(refusal("electrns=5"), AllOf(HasSubstr("'electrns'"), HasSubstr("'electrons'")));
  EXPECT_THAT(refusal(""), HasSubstr("unknown name ''"));
  EXPECT_THAT(refusal("zzzzzzzzzzzzzzzzzz"), HasSubstr("known are electrons, gain"));
}

TEST(ParseInjection, NamesWhatWasFoundAndWhatIsAllowed) {
  EXPECT_THAT(refusal("gain"), AllOf(HasSubstr("value is missing"), HasSubstr("0.01 to 100")));
  EXPECT_THAT(refusal("gain="), AllOf(HasSubstr("found ''"), HasSubstr("0.01 to 100")));
  EXPECT_THAT(refusal("gain=x"), AllOf(HasSubstr("found 'x'"), HasSubstr("gain=F")));
  for (const char* text : {"gain=0", "gain=-1", "gain=101", "gain=nan", "gain=inf", "gain=1e999",
                           "gain= 2", "gain=2 ", "gain=2=3", "gain=0x2"}) {
    EXPECT_THAT(refusal(text), HasSubstr("allowed is gain=F with a number from 0.01 to 100"))
        << text;
  }
}

TEST(ParseInjection, RefusesARangeWithoutFrames) {
  for (const char* text : {"gain=2@", "gain=2@5", "gain=2@5:5", "gain=2@6:5", "gain=2@-1:5",
                           "gain=2@a:5", "gain=2@1:b", "gain=2@1:2:3", "gain=2@1:2@3:4",
                           "gain=2@1.5:3", "gain=2@99999999999999999999:"}) {
    EXPECT_THAT(refusal(text), HasSubstr("allowed is FIRST:LAST")) << text;
  }
}

TEST(ParseInjection, RefusesWhatIsNoSeed) {
  EXPECT_THAT(refusal("gain=2,sed=3"), AllOf(HasSubstr("'sed'"), HasSubstr("'seed'")));
  for (const char* text : {"gain=2,", "gain=2,7", "gain=2,gain=3", "gain=2, seed=3"}) {
    EXPECT_THAT(refusal(text), HasSubstr("unknown key")) << text;
  }
  for (const char* text :
       {"gain=2,seed", "gain=2,seed=", "gain=2,seed=-1", "gain=2,seed=1.5", "gain=2,seed=x",
        "gain=2,seed=3,seed=4", "gain=2,seed=1@3:4", "gain=2,seed=9007199254740993"}) {
    EXPECT_THAT(refusal(text), HasSubstr("from 0 to 9007199254740992")) << text;
  }
}

TEST(ParseInjections, StopsAtTheFirstThatIsWrong) {
  const std::vector<std::string> good = {"gain=2", "electrons=3"};
  ASSERT_EQ(parse_injections(good)->size(), 2u);
  const std::vector<std::string> bad = {"gain=2", "gian=3", "gain=0"};
  EXPECT_THAT(parse_injections(bad).error().message, HasSubstr("'gian=3'"));
}

// With a value where there is one.
std::string example_of(const InjectionKind& kind) {
  const std::string name(kind.name);
  if (kind.form == ValueForm::kNone) return name;
  if (kind.form == ValueForm::kWord) {
    return name + "=" + std::string(kind.value_name.substr(0, kind.value_name.find('|')));
  }
  return name + "=" + std::to_string(kind.highest);
}

// Whatever comes is refused with a message, or is within all bounds.
TEST(ParseInjection, SurvivesAnyTextAtAll) {
  test::Random random(5);
  int taken = 0;
  const std::string marks = "=@:,.-+e0159 seedgainNaN|\xff\n";
  for (int round = 0; round < 20000; ++round) {
    const auto kinds = injection_kinds();
    const auto& kind =
        kinds[static_cast<std::size_t>(random.integer(0, static_cast<int>(kinds.size()) - 1))];
    std::string text = example_of(kind) + "@10:20,seed=5";
    for (int edit = random.integer(0, 4); edit > 0 && !text.empty(); --edit) {
      const auto at =
          static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()) - 1));
      const char mark =
          marks[static_cast<std::size_t>(random.integer(0, static_cast<int>(marks.size()) - 1))];
      switch (random.integer(0, 3)) {
        case 0:
          text.erase(at, 1);
          break;
        case 1:
          text.insert(at, 1, mark);
          break;
        case 2:
          text[at] = mark;
          break;
        default:
          text.resize(at);
          break;
      }
    }
    const auto injection = parse_injection(text);
    if (!injection) {
      EXPECT_FALSE(injection.error().message.empty());
      continue;
    }
    ++taken;
    EXPECT_GE(injection->first, 0) << text;
    EXPECT_GT(injection->last, injection->first) << text;
    EXPECT_LE(injection->seed, std::uint64_t{1} << 53) << text;
    if (injection->kind->form == ValueForm::kNumber) {
      EXPECT_GE(injection->value, injection->kind->lowest) << text;
      EXPECT_LE(injection->value, injection->kind->highest) << text;
    }
    EXPECT_NE(injection->kind->make(*injection), nullptr);
  }
  EXPECT_GT(taken, 2000);
  EXPECT_LT(taken, 18000);
}

TEST(DescribeInjections, HasALineAKindThatFitsATerminal) {
  const std::string text = describe_injections();
  for (const InjectionKind& kind : injection_kinds()) {
    EXPECT_THAT("\n" + text, HasSubstr("\n  " + std::string(kind.name)));
    EXPECT_FALSE(kind.meaning.empty()) << kind.name;
    EXPECT_TRUE(parse_injection(example_of(kind)).has_value()) << kind.name;
  }
  std::size_t start = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
    EXPECT_LE(end - start, 100u) << text.substr(start, end - start);
    start = end + 1;
  }
}

}  // namespace
}  // namespace darkling
