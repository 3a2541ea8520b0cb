// SPDX-License-Identifier: Apache-2.0
#include "drivers/pairing/pair_frames.h"

#include <map>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

FrameTime at(int ms) {
  return frame_time_from_ns(ms * 1'000'000LL);
}

// What came out: "3+5" for a pair of stamps in ms, "3-" and "-5" for frames alone.
std::vector<std::string> drain(PairFrames& pairing) {
  std::vector<std::string> found;
  const auto text = [](const StampedFrame& frame) {
    return std::to_string(to_ns(frame.stamp) / 1'000'000);
  };
  while (true) {
    const PairResult result = pairing.next();
    switch (result.outcome) {
      case PairOutcome::kNothing:
        return found;
      case PairOutcome::kPair:
        found.push_back(text(result.left) + "+" + text(result.right));
        break;
      case PairOutcome::kUnpairedLeft:
        found.push_back(text(result.left) + "-");
        break;
      case PairOutcome::kUnpairedRight:
        found.push_back("-" + text(result.right));
        break;
    }
  }
}

class PairFramesTest : public ::testing::Test {
 protected:
  void left(int ms) { pairing_.push(Eye::kLeft, {.stamp = at(ms)}); }
  void right(int ms) { pairing_.push(Eye::kRight, {.stamp = at(ms)}); }
  PairFrames pairing_{milliseconds(5)};
};

TEST_F(PairFramesTest, WaitsForTheOtherEye) {
  EXPECT_THAT(drain(pairing_), IsEmpty());
  left(0);
  EXPECT_THAT(drain(pairing_), IsEmpty());
  right(1);
  EXPECT_THAT(drain(pairing_), ElementsAre("0+1"));
  EXPECT_THAT(drain(pairing_), IsEmpty());
}

TEST_F(PairFramesTest, PairsAtTheToleranceAndDropsTheOlderBeyondIt) {
  left(0);
  right(5);
  EXPECT_THAT(drain(pairing_), ElementsAre("0+5"));
  left(50);
  right(56);
  EXPECT_THAT(drain(pairing_), ElementsAre("50-"));
  left(57);
  EXPECT_THAT(drain(pairing_), ElementsAre("57+56"));
}

TEST_F(PairFramesTest, TakesTheNearestOfThoseThatAreHere) {
  left(0);
  left(3);
  right(4);
  EXPECT_THAT(drain(pairing_), ElementsAre("0-", "3+4"));
  right(50);
  right(52);
  left(53);
  EXPECT_THAT(drain(pairing_), ElementsAre("-50", "53+52"));
}

TEST_F(PairFramesTest, DropsTheOldestOfAnEyeWhoseOtherHasStalled) {
  left(0);
  EXPECT_THAT(drain(pairing_), IsEmpty());
  left(50);
  EXPECT_THAT(drain(pairing_), IsEmpty());
  left(100);
  EXPECT_THAT(drain(pairing_), ElementsAre("0-"));
  left(150);
  EXPECT_THAT(drain(pairing_), ElementsAre("50-"));
  right(151);
  EXPECT_THAT(drain(pairing_), ElementsAre("100-", "150+151"));
}

TEST_F(PairFramesTest, KeepsBuffersAndIndicesWithTheirFrames) {
  pairing_.push(Eye::kLeft, {.stamp = at(0), .index = 7, .buffer = 2});
  pairing_.push(Eye::kRight, {.stamp = at(1), .index = 9, .buffer = 3});
  const PairResult pair = pairing_.next();
  EXPECT_EQ(pair.left.index, 7);
  EXPECT_EQ(pair.left.buffer, 2);
  EXPECT_EQ(pair.right.index, 9);
  EXPECT_EQ(pair.right.buffer, 3);
}

TEST_F(PairFramesTest, BearsStampsAtBothEndsOfTime) {
  pairing_.push(Eye::kLeft, {.stamp = FrameTime::min()});
  pairing_.push(Eye::kRight, {.stamp = FrameTime::max()});
  EXPECT_EQ(pairing_.next().outcome, PairOutcome::kUnpairedLeft);
  EXPECT_EQ(pairing_.next().outcome, PairOutcome::kNothing);
}

using PairFramesDeathTest = PairFramesTest;

TEST_F(PairFramesDeathTest, RefusesFramesThatItWasNotAskedAbout) {
  left(0);
  left(50);
  left(100);
  EXPECT_DEATH(left(150), "next");
}

// Two streams with whatever real ones do, and the rules that hold all the same.
class RandomStreams {
 public:
  explicit RandomStreams(std::uint64_t seed)
      : random_(seed), max_skew_(milliseconds(random_.integer(0, 24))), pairing_(max_skew_) {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      step(Eye::kLeft);
      step(Eye::kRight);
      now_ms_ += 50;
    }
  }
  void check_totals() {
    for (const std::size_t eye : {0U, 1U}) {
      const std::int64_t waiting = pushed_[eye] - taken_[eye];
      EXPECT_GE(waiting, 0);
      EXPECT_LT(waiting, static_cast<std::int64_t>(PairFrames::kCapacity));
    }
  }
  [[nodiscard]] int pairs() const { return pairs_; }

 private:
  void step(Eye eye) {
    const auto e = static_cast<std::size_t>(eye);
    if (random_.integer(0, 99) < 2) stall_[e] = random_.integer(1, 9);
    if (stall_[e] > 0) {
      held_[e].clear();
      --stall_[e];
      return;
    }
    if (random_.integer(0, 9) == 0) return;  // dropped
    held_[e].push_back(now_ms_ + random_.integer(-8, 8));
    if (random_.integer(0, 9) == 0) return;  // comes with the next one
    if (held_[e].size() > 1 && random_.integer(0, 1) == 0) std::swap(held_[e][0], held_[e][1]);
    for (const int ms : held_[e]) push(eye, ms);
    held_[e].clear();
  }

  void push(Eye eye, int ms) {
    auto& count = pushed_[static_cast<std::size_t>(eye)];
    pairing_.push(eye, {.stamp = at(ms), .index = count++});
    for (PairResult result = pairing_.next(); result.outcome != PairOutcome::kNothing;
         result = pairing_.next()) {
      check(result);
    }
  }

  // Frames leave in the order in which they came, so each leaves once.
  void check(const PairResult& result) {
    if (result.outcome != PairOutcome::kUnpairedRight) {
      EXPECT_EQ(result.left.index, taken_[0]++);
    }
    if (result.outcome != PairOutcome::kUnpairedLeft) {
      EXPECT_EQ(result.right.index, taken_[1]++);
    }
    if (result.outcome != PairOutcome::kPair) return;
    ++pairs_;
    EXPECT_LE(std::chrono::abs(result.left.stamp - result.right.stamp), max_skew_);
  }

  Random random_;
  Duration max_skew_;
  PairFrames pairing_;
  int now_ms_ = 1000;
  std::array<std::vector<int>, 2> held_;
  std::array<int, 2> stall_ = {};
  std::array<std::int64_t, 2> pushed_ = {};
  std::array<std::int64_t, 2> taken_ = {};
  int pairs_ = 0;
};

TEST(PairFramesRules, HoldUnderDropsSwapsStallsAndJitter) {
  int pairs = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomStreams streams(seed);
    streams.run(200);
    streams.check_totals();
    pairs += streams.pairs();
  }
  EXPECT_GT(pairs, 10'000);  // the rules do not hold for want of pairs
}

// With a tolerance above the jitter, only what was dropped stays alone.
TEST(PairFramesRules, PairEveryFrameThatHasAPartner) {
  Random random(5);
  PairFrames pairing(milliseconds(20));
  std::map<PairOutcome, int> outcomes;
  int complete = 0;
  for (int k = 0; k < 2000; ++k) {
    const bool has_left = random.integer(0, 9) != 0;
    const bool has_right = random.integer(0, 9) != 0;
    complete += has_left && has_right ? 1 : 0;
    const auto jittered = [&] { return at(k * 50 + random.integer(0, 8)); };
    if (has_left) pairing.push(Eye::kLeft, {.stamp = jittered(), .index = k});
    if (has_right) pairing.push(Eye::kRight, {.stamp = jittered(), .index = k});
    for (PairResult r = pairing.next(); r.outcome != PairOutcome::kNothing; r = pairing.next()) {
      ++outcomes[r.outcome];
      if (r.outcome == PairOutcome::kPair) {
        EXPECT_EQ(r.left.index, r.right.index);
      }
    }
  }
  EXPECT_EQ(outcomes[PairOutcome::kPair], complete);
}

}  // namespace
}  // namespace darkling::test
