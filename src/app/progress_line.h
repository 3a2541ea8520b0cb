// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/time.h"
#include "vo/estimate.h"

namespace darkling {

// One line on standard error that says how far a run is, rewritten a few times a second; nothing at
// all when standard error is not a terminal.
class ProgressLine {
 public:
  // @param frame_count  expected; 0 when unknown.
  explicit ProgressLine(std::int64_t frame_count);
  ~ProgressLine();  // leaves the line empty
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // @param frames  done so far. @param status  of the last.
  void show(std::int64_t frames, TrackStatus status);
  // The same where nothing is tracked.
  void show(std::int64_t frames);

 private:
  void write(std::int64_t frames, const char* state);

  std::int64_t frame_count_;
  bool is_on_;
  MonotonicTime started_at_;
  MonotonicTime shown_at_;
};

}  // namespace darkling
