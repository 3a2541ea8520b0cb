// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/image_size.h"
#include "drivers/frame_source.h"

namespace darkling::test {

// A pair as a value, to make up, to compare and to print.
struct PlainPair {
  std::int64_t sequence = 0;
  FrameTime stamp;
  FrameFault fault = FrameFault::kNone;  // another: a bad frame, without pixels
  std::vector<std::uint8_t> left = {};
  std::vector<std::uint8_t> right = {};
  bool operator==(const PlainPair&) const = default;
};

// Plays pairs that a test made up.
class PlainSource final : public FrameSource {
 public:
  // @pre the pixels of every pair are as many as `size` says.
  PlainSource(ImageSize size, std::vector<PlainPair> pairs)
      : size_(size), pairs_(std::move(pairs)) {}

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override {}
  [[nodiscard]] SourceStats stats() const override { return stats_; }

 private:
  ImageSize size_;
  std::vector<PlainPair> pairs_;
  std::size_t next_ = 0;
  SourceStats stats_;
};

// `count` pairs at 20 Hz: a texture that drifts to the left by two pixels a frame, its middle at
// level 100, which the right eye sees four pixels further to the left.
[[nodiscard]] std::vector<PlainPair> drifting_pairs(ImageSize size, int count);

// `count` pairs of one level.
[[nodiscard]] std::vector<PlainPair> flat_pairs(ImageSize size, int count, std::uint8_t level);

// All that comes out of `source`, from start() to its end.
[[nodiscard]] std::vector<PlainPair> play_all(FrameSource& source);

// What `pairs` are with the injections put in, each as --inject takes it.
[[nodiscard]] std::vector<PlainPair> inject(ImageSize size, const std::vector<PlainPair>& pairs,
                                            const std::vector<std::string>& injections);

}  // namespace darkling::test
