// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/time.h"

namespace darkling {

enum class Eye { kLeft = 0, kRight = 1 };

// One eye's frame while it waits for the other's.
struct StampedFrame {
  FrameTime stamp;         // mid-exposure
  std::int64_t index = 0;  // position in its eye's stream; a gap means frames that were lost
  int buffer = -1;         // where its pixels are: the caller's business
};

enum class PairOutcome {
  kNothing = 0,    // wait for more frames
  kPair,           // both members are set
  kUnpairedLeft,   // `left` will never have a partner
  kUnpairedRight,  // `right` will never have a partner
};

struct [[nodiscard]] PairResult {
  PairOutcome outcome = PairOutcome::kNothing;
  StampedFrame left = {};
  StampedFrame right = {};
};

// Makes pairs of two streams of frames whose shutters nobody synchronised, by their stamps: a frame
// takes the nearest of those of the other eye that are here and within the skew. It does not wait
// for a nearer one, which would cost a period of delay; with a skew below half a period there is
// none. Each frame is taken out once, alone or in a pair, and both streams keep their order.
class PairFrames {
 public:
  // How many frames of one eye are held; one that is full after next() has lost its oldest, so that
  // at most one less wait.
  static constexpr std::size_t kCapacity = 3;

  // @param max_skew  between the two stamps of a pair, inclusive.
  explicit PairFrames(Duration max_skew) : max_skew_(max_skew) {}

  // @pre next() has said kNothing since the last frame of this eye.
  void push(Eye eye, const StampedFrame& frame);

  // To be called until it says kNothing.
  PairResult next();

 private:
  using Queue = FixedVector<StampedFrame, kCapacity>;

  [[nodiscard]] PairOutcome decide() const;

  Duration max_skew_;
  std::array<Queue, 2> waiting_;
};

}  // namespace darkling
