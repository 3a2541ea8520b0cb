// SPDX-License-Identifier: Apache-2.0
// What holds of every injection, whatever it is named.
#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "drivers/injection/injected_source.h"
#include "support/plain_source.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::inject;
using test::PlainPair;

constexpr ImageSize kSize{.width = 37, .height = 29};

// With a value in range, drawn anew.
std::string any_injection(const InjectionKind& kind, test::Random& random) {
  const std::string name(kind.name);
  if (kind.form == ValueForm::kNone) return name;
  if (kind.form == ValueForm::kWord) return name + (random.integer(0, 1) == 0 ? "=left" : "=right");
  if (kind.form == ValueForm::kWholeNumber) {
    const int value = random.integer(static_cast<int>(kind.lowest), static_cast<int>(kind.highest));
    return name + "=" + std::to_string(value);
  }
  // As many small ones as large ones.
  const double share = std::pow(random.uniform(0.0, 1.0), 3.0);
  return name + "=" + std::to_string(kind.lowest + share * (kind.highest - kind.lowest));
}

// Drifting, with losses and gaps in the sequence.
std::vector<PlainPair> rough_pairs(test::Random& random) {
  std::vector<PlainPair> pairs;
  for (PlainPair& pair : test::drifting_pairs(kSize, 30)) {
    const int fate = random.integer(0, 9);
    if (fate == 0) continue;
    if (fate == 1) {
      pair = {.sequence = pair.sequence, .stamp = pair.stamp, .fault = FrameFault::kUnpaired};
    }
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const InjectionKind& kind : injection_kinds()) names.emplace_back(kind.name);
  return names;
}

const InjectionKind& kind_named(const std::string& name) {
  return *std::ranges::find(injection_kinds(), name, &InjectionKind::name);
}

class EveryInjection : public ::testing::TestWithParam<std::string> {
 protected:
  std::string any() { return any_injection(kind_named(GetParam()), random_); }

  test::Random random_{7};
  std::vector<PlainPair> pairs_ = rough_pairs(random_);
};

TEST_P(EveryInjection, GivesTheSameOnEveryRun) {
  for (int round = 0; round < 5; ++round) {
    const std::string injection = any();
    EXPECT_EQ(inject(kSize, pairs_, {injection}), inject(kSize, pairs_, {injection})) << injection;
  }
}

TEST_P(EveryInjection, KeepsSequencesStampsAndWhatTheSourceLost) {
  const auto injected = inject(kSize, pairs_, {any()});
  ASSERT_EQ(injected.size(), pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    EXPECT_EQ(injected[i].sequence, pairs_[i].sequence);
    EXPECT_EQ(injected[i].stamp, pairs_[i].stamp);
    EXPECT_TRUE(pairs_[i].fault == FrameFault::kNone || injected[i] == pairs_[i]) << i;
  }
}

TEST_P(EveryInjection, EndsWithItsRange) {
  const auto injected = inject(kSize, pairs_, {any() + "@10:20"});
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (pairs_[i].sequence >= 10 && pairs_[i].sequence < 20) continue;
    EXPECT_EQ(injected[i], pairs_[i]) << pairs_[i].sequence;
  }
}

TEST_P(EveryInjection, TakesImagesOfAnySize) {
  for (const ImageSize size : {ImageSize{1, 1}, {2, 1}, {1, 3}, {5, 4}, {640, 4}, {3, 200}}) {
    const auto pairs = test::drifting_pairs(size, 5);
    for (int round = 0; round < 5; ++round) {
      EXPECT_EQ(inject(size, pairs, {any()}).size(), 5u);
    }
  }
}

// Waiting in vain for a buffer changes nothing of what comes then.
TEST_P(EveryInjection, DoesNotMindWhenFramesAreAskedForOrHeld) {
  const std::string text = any();
  const auto once = inject(kSize, pairs_, {text});
  InjectedSource source(std::make_unique<test::PlainSource>(kSize, pairs_), kSize,
                        {*parse_injection(text)});
  ASSERT_TRUE(source.start().has_value());
  std::vector<WaitResult> held;
  std::size_t next = 0;
  while (next < once.size()) {
    if (!held.empty() && random_.integer(0, 1) == 0) {
      held.erase(held.begin() + random_.integer(0, static_cast<int>(held.size()) - 1));
    }
    WaitResult result = source.wait_next({});
    if (result.status == WaitStatus::kTimeout) continue;
    const PlainPair& expected = once[next++];
    EXPECT_EQ(result.fault, expected.fault);
    if (result.status != WaitStatus::kFrame) continue;
    const StereoFrame& frame = result.lease.frame();
    EXPECT_EQ(frame.left.at(20, 20), expected.left[20 * 37 + 20]);
    EXPECT_EQ(frame.right.at(30, 25), expected.right[25 * 37 + 30]);
    held.push_back(std::move(result));
  }
  held.clear();
  source.stop();
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryInjection, ::testing::ValuesIn(all_names()),
                         [](const auto& kind) { return kind.param; });

// In any order and number, one after the other.
TEST(SeveralInjections, GiveTheSameOnEveryRun) {
  test::Random random(11);
  for (int round = 0; round < 60; ++round) {
    const auto pairs = rough_pairs(random);
    std::vector<std::string> texts;
    for (int count = random.integer(1, 5); count > 0; --count) {
      const auto kinds = injection_kinds();
      const int index = random.integer(0, static_cast<int>(kinds.size()) - 1);
      const int first = random.integer(0, 25);
      texts.push_back(any_injection(kinds[static_cast<std::size_t>(index)], random) + "@" +
                      std::to_string(first) + ":" + std::to_string(first + 10));
    }
    const auto once = inject(kSize, pairs, texts);
    EXPECT_EQ(once.size(), pairs.size());
    EXPECT_EQ(once, inject(kSize, pairs, texts));
  }
}

}  // namespace
}  // namespace darkling
