// SPDX-License-Identifier: Apache-2.0
#include "app/progress_line.h"

#include <cstdio>

#include "platform/clocks.h"
#include "platform/terminal.h"

namespace darkling {

namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(100);
constexpr const char* kEraseLine = "\r\033[K";

const char* name_of(TrackStatus status) {
  switch (status) {
    case TrackStatus::kValid:
      return ", tracking";
    case TrackStatus::kDegraded:
      return ", degraded";
    case TrackStatus::kLost:
      return ", lost";
    case TrackStatus::kUnknown:
      break;
  }
  return ", starting";
}

}  // namespace

ProgressLine::ProgressLine(std::int64_t frame_count)
    : frame_count_(frame_count),
      is_on_(is_stderr_terminal()),
      started_at_(read_monotonic_clock()),
      shown_at_(started_at_) {}

ProgressLine::~ProgressLine() {
  if (is_on_) std::fputs(kEraseLine, stderr);
}

void ProgressLine::show(std::int64_t frames, TrackStatus status) {
  write(frames, name_of(status));
}

void ProgressLine::show(std::int64_t frames) {
  write(frames, "");
}

void ProgressLine::write(std::int64_t frames, const char* state) {
  if (!is_on_) return;
  const MonotonicTime now = read_monotonic_clock();
  if (now - shown_at_ < kPeriod) return;
  shown_at_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - started_at_).count();
  const double rate_hz = static_cast<double>(frames) / elapsed_s;
  if (frame_count_ > 0) {
    std::fprintf(stderr, "%sframe %lld of %lld, %.0f a second%s", kEraseLine,
                 static_cast<long long>(frames), static_cast<long long>(frame_count_), rate_hz,
                 state);
  } else {
    std::fprintf(stderr, "%sframe %lld, %.0f a second%s", kEraseLine,
                 static_cast<long long>(frames), rate_hz, state);
  }
  std::fflush(stderr);
}

}  // namespace darkling
