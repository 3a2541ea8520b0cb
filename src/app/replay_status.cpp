// SPDX-License-Identifier: Apache-2.0
#include "app/replay_status.h"

namespace darkling {

namespace {

constexpr std::size_t kMostName = 1000;  // of a message's few thousand bytes
constexpr Duration kStatusPeriod = std::chrono::milliseconds(500);  // as of the service

MonotonicTime as_monotonic(FrameTime stamp) {
  return MonotonicTime(stamp.time_since_epoch());
}

}  // namespace

ReplayStatus::ReplayStatus(const ReplayFacts& facts) : period_(facts.period) {
  status_.latency_p50_ms = -1.0;
  status_.latency_max_ms = -1.0;
  status_.exposure_ms = -1.0;
  status_.gain = -1.0;
  status_.arena_bytes = facts.arena_bytes;
  status_.heap_calls = -1;
  status_.width = facts.width_px;
  status_.height = facts.height_px;
  status_.kernels = facts.kernels;
  status_.version = DARKLING_VERSION;
  status_.camera = facts.source.substr(0, kMostName);
}

void ReplayStatus::add(const WaitResult& pair, const Estimate& estimate) {
  stamp_ = estimate.stamp;
  if (!health_) {
    health_.emplace(as_monotonic(stamp_), period_);
    first_stamp_ = stamp_;
  }
  health_->observe(estimate, as_monotonic(stamp_));
  status_.reset_counter = estimate.reset_counter;
  ++status_.frames_in;
  if (pair.status == WaitStatus::kBadFrame) {
    ++(pair.fault == FrameFault::kUnpaired ? status_.frames_unpaired : status_.frames_bad);
  } else {
    ++(estimate.status == TrackStatus::kLost ? status_.frames_lost : status_.frames_tracked);
  }
}

std::optional<status_t> ReplayStatus::take_due() {
  const bool is_due = !status_stamp_ || stamp_ < *status_stamp_ ||  // stamps may go back
                      stamp_ - *status_stamp_ >= kStatusPeriod;
  return is_due ? std::optional(take()) : std::nullopt;
}

std::optional<status_t> ReplayStatus::take_last() {
  return health_ ? std::optional(take()) : std::nullopt;
}

status_t ReplayStatus::take() {
  const MonotonicTime now = as_monotonic(stamp_);
  status_.mono_ns = to_ns(stamp_);
  status_.utime = status_.mono_ns / 1000;
  status_.state =
      static_cast<std::int8_t>(health_->judge(now, Health::Camera::kOpen, /*threads*/ true));
  status_.reasons = static_cast<std::int32_t>(health_->take_reasons());
  status_.uptime_s = std::chrono::duration<double>(stamp_ - first_stamp_).count();
  const Duration since = status_stamp_ ? stamp_ - *status_stamp_ : Duration::zero();
  const double seconds = std::chrono::duration<double>(since).count();
  const std::int64_t out = status_.frames_tracked + status_.frames_lost;
  const auto rate_hz = [seconds](std::int64_t count) {
    return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0;
  };
  status_.rate_in_hz = rate_hz(status_.frames_in - in_before_);
  status_.rate_out_hz = rate_hz(out - out_before_);
  in_before_ = status_.frames_in;
  out_before_ = out;
  status_stamp_ = stamp_;
  return status_;
}

}  // namespace darkling
