// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/frame_source.h"

namespace darkling {

// A short recording or scene without end: its frames are taken into memory once and then played
// forwards and backwards for ever, so that the motion stays continuous. Stamps run on at `rate_hz`.
class RehearsedSource final : public FrameSource {
 public:
  // @param source  all of which fits into memory.
  // @param frames  how many to deliver before the end; 0: without end.
  RehearsedSource(std::unique_ptr<FrameSource> source, double rate_hz, std::int64_t frames = 0)
      : source_(std::move(source)), rate_hz_(rate_hz), frames_(frames) {}

  // @return the source's own errors, and kBadInput when it has fewer than two whole frames.
  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override {}  // what was learned by heart stays
  [[nodiscard]] SourceStats stats() const override {
    return {.delivered = delivered_.load(std::memory_order_relaxed)};
  }

 private:
  struct Pair {
    StereoFrame frame;  // of the two below
    std::vector<std::uint8_t> left;
    std::vector<std::uint8_t> right;
  };
  [[nodiscard]] Result<void> rehearse();

  std::unique_ptr<FrameSource> source_;  // until it is learned by heart
  double rate_hz_;
  std::int64_t frames_;
  std::vector<Pair> pairs_;
  // Written by the thread that waits for frames, read by any.
  std::atomic<std::int64_t> delivered_ = 0;
};

}  // namespace darkling
