// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <gtest/gtest.h>

#include "drivers/injection/injected_source.h"
#include "support/plain_source.h"

namespace darkling {
namespace {

using test::inject;
using test::PlainPair;
using test::PlainSource;

constexpr ImageSize kSize{.width = 40, .height = 30};

std::unique_ptr<InjectedSource> source_of(std::vector<PlainPair> pairs,
                                          const std::vector<std::string>& injections,
                                          ImageSize size = kSize) {
  return std::make_unique<InjectedSource>(std::make_unique<PlainSource>(kSize, std::move(pairs)),
                                          size, *parse_injections(injections));
}

TEST(InjectedSource, GivesTheSourceAsItIsWithoutInjections) {
  auto pairs = test::drifting_pairs(kSize, 4);
  pairs[2] = {.sequence = 2, .stamp = pairs[2].stamp, .fault = FrameFault::kUnpaired};
  EXPECT_EQ(inject(kSize, pairs, {}), pairs);
}

TEST(InjectedSource, LeavesFramesOutOfRangeAsTheyAre) {
  const auto pairs = test::drifting_pairs(kSize, 5);
  const auto injected = inject(kSize, pairs, {"gain=2@1:3"});
  for (const std::size_t i : {0, 3, 4}) EXPECT_EQ(injected[i], pairs[i]) << i;
  for (const std::size_t i : {1, 2}) EXPECT_NE(injected[i], pairs[i]) << i;
}

TEST(InjectedSource, GoesByTheSequenceNotByTheCount) {
  auto pairs = test::drifting_pairs(kSize, 2);
  pairs[0].sequence = 100;
  pairs[1].sequence = 102;
  const auto injected = inject(kSize, pairs, {"gain=2@101:103"});
  EXPECT_EQ(injected[0], pairs[0]);
  EXPECT_NE(injected[1], pairs[1]);
}

TEST(InjectedSource, AppliesInTheOrderGiven) {
  const auto pairs = test::flat_pairs(kSize, 1, 200);
  EXPECT_EQ(inject(kSize, pairs, {"gain=2", "gain=0.5"})[0].left[0], 128);
  EXPECT_EQ(inject(kSize, pairs, {"gain=0.5", "gain=2"})[0].left[0], 200);
}

TEST(InjectedSource, GivesTheSameAfterAnotherStart) {
  const auto source = source_of(test::drifting_pairs(kSize, 3), {"electrons=20", "gain=1.5@1:2"});
  const auto once = test::play_all(*source);
  EXPECT_EQ(once, test::play_all(*source));
}

TEST(InjectedSource, HoldsItsFramesWhileTheyAreOnLoanAndThenTimesOut) {
  const auto source = source_of(test::drifting_pairs(kSize, 5), {"gain=2"});
  const auto all = test::play_all(*source);
  ASSERT_TRUE(source->start().has_value());
  std::vector<WaitResult> held;
  for (int i = 0; i < InjectedSource::kSlotCount; ++i) held.push_back(source->wait_next({}));
  EXPECT_EQ(source->wait_next({}).status, WaitStatus::kTimeout);
  for (std::size_t i = 0; i < held.size(); ++i) {
    ASSERT_EQ(held[i].status, WaitStatus::kFrame);
    EXPECT_EQ(held[i].lease.frame().left.at(7, 0), all[i].left[7]);
  }
  held.erase(held.begin());
  const WaitResult next = source->wait_next({});
  ASSERT_EQ(next.status, WaitStatus::kFrame);
  EXPECT_EQ(next.lease.frame().sequence, InjectedSource::kSlotCount) << "none is passed over";
}

TEST(InjectedSource, RefusesPairsOfAnotherSize) {
  const auto source = source_of(test::drifting_pairs(kSize, 2), {}, {.width = 30, .height = 40});
  const auto pairs = test::play_all(*source);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].fault, FrameFault::kWrongSize);
  EXPECT_EQ(source->stats().delivered, 0);
  EXPECT_EQ(source->stats().wrong_size, 2);
}

TEST(InjectedSource, CountsAsTheSourceDoes) {
  auto pairs = test::drifting_pairs(kSize, 4);
  pairs[2].fault = FrameFault::kUnpaired;
  const auto source = source_of(pairs, {"gain=2"});
  EXPECT_EQ(test::play_all(*source).size(), 4u);
  EXPECT_EQ(source->stats().delivered, 3);
  EXPECT_EQ(source->stats().unpaired, 1);
}

}  // namespace
}  // namespace darkling
