// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "drivers/pairing/pair_frames.h"

namespace darkling {

// Makes a device's own frame numbers, 32 bits which drivers may start anywhere, repeat or restart,
// into an index that grows with every frame and jumps over those that the device lost.
class FrameIndex {
 public:
  // More missing than this, or numbers that go back, is a restart, not a loss.
  static constexpr std::uint32_t kMaxGap = 1000;

  // @return the index of the frame that the device calls `device_sequence`; the first is 0.
  std::int64_t advance(std::uint32_t device_sequence) {
    const std::uint32_t step = device_sequence - last_sequence_;
    const bool is_gap = index_ >= 0 && step > 1 && step <= kMaxGap + 1;
    lost_ = is_gap ? static_cast<std::int64_t>(step) - 1 : 0;
    last_sequence_ = device_sequence;
    index_ += 1 + lost_;
    return index_;
  }

  // How many frames were lost just before the last one.
  [[nodiscard]] std::int64_t lost() const { return lost_; }

 private:
  std::int64_t index_ = -1;
  std::int64_t lost_ = 0;
  std::uint32_t last_sequence_ = 0;
};

// Numbers the pairs of a source so that what either eye lost leaves a gap, once. The two eyes count
// from different starts; the last pair says how the two counts belong together.
class NumberPairs {
 public:
  // Both streams begin anew, at index 0. @param lost  pairs that nobody took since the last number.
  void restart(std::int64_t lost) {
    last_ += lost;
    offset_ = {last_ + 1, last_ + 1};
  }

  // @return the pair's number, greater than all before.
  std::int64_t number_pair(std::int64_t left_index, std::int64_t right_index) {
    const std::int64_t number = std::max(last_ + 1, left_index + offset_[0]);
    offset_ = {number - left_index, number - right_index};
    return last_ = number;
  }

  // The number of the pair that lacks this frame's partner. The partner may have come too, and
  // found nobody either: `is_new` is false for the second of the two.
  struct Missing {
    std::int64_t number = 0;
    bool is_new = false;
  };
  Missing number_unpaired(Eye eye, std::int64_t index) {
    const std::int64_t number = index + offset_[static_cast<std::size_t>(eye)];
    if (number <= last_) return {.number = number, .is_new = false};
    last_ = number;
    return {.number = number, .is_new = true};
  }

 private:
  std::array<std::int64_t, 2> offset_ = {};
  std::int64_t last_ = -1;
};

}  // namespace darkling
