// SPDX-License-Identifier: Apache-2.0
#include "drivers/pairing/pair_frames.h"

namespace darkling {

namespace {

// Frames of two unrelated clocks may be further apart than a signed difference can say.
Duration distance(FrameTime a, FrameTime b) {
  const auto a_ns = static_cast<std::uint64_t>(to_ns(a));
  const auto b_ns = static_cast<std::uint64_t>(to_ns(b));
  const std::uint64_t apart_ns = a < b ? b_ns - a_ns : a_ns - b_ns;
  constexpr auto kMost = static_cast<std::uint64_t>(Duration::max().count());
  return Duration{static_cast<std::int64_t>(apart_ns < kMost ? apart_ns : kMost)};
}

}  // namespace

void PairFrames::push(Eye eye, const StampedFrame& frame) {
  const bool has_room = waiting_[static_cast<std::size_t>(eye)].push_back(frame);
  CHECK(has_room, "next() is called until nothing is left before another frame comes");
}

PairOutcome PairFrames::decide() const {
  const auto& [left, right] = waiting_;
  if (left.is_empty() || right.is_empty()) {
    if (left.is_full()) return PairOutcome::kUnpairedLeft;
    return right.is_full() ? PairOutcome::kUnpairedRight : PairOutcome::kNothing;
  }
  const Duration skew = distance(left[0].stamp, right[0].stamp);
  if (skew > max_skew_) {
    return left[0].stamp < right[0].stamp ? PairOutcome::kUnpairedLeft
                                          : PairOutcome::kUnpairedRight;
  }
  if (left.size() > 1 && distance(left[1].stamp, right[0].stamp) < skew) {
    return PairOutcome::kUnpairedLeft;
  }
  if (right.size() > 1 && distance(left[0].stamp, right[1].stamp) < skew) {
    return PairOutcome::kUnpairedRight;
  }
  return PairOutcome::kPair;
}

PairResult PairFrames::next() {
  PairResult result = {.outcome = decide()};
  const bool is_pair = result.outcome == PairOutcome::kPair;
  if (is_pair || result.outcome == PairOutcome::kUnpairedLeft) {
    result.left = waiting_[0][0];
    waiting_[0].erase(0);
  }
  if (is_pair || result.outcome == PairOutcome::kUnpairedRight) {
    result.right = waiting_[1][0];
    waiting_[1].erase(0);
  }
  return result;
}

}  // namespace darkling
