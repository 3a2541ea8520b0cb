// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "drivers/frame_source.h"

namespace darkling {

// What a source counts and says of its camera, written by the thread that waits for frames and read
// by any. Each number is whole; together they may be of two successive frames. No lock: a reader
// that is preempted must not hold up a real-time capture.
class PublishedStats {
 public:
  void store(const SourceStats& stats) {
    delivered_.store(stats.delivered, kRelaxed);
    unreadable_.store(stats.unreadable, kRelaxed);
    wrong_size_.store(stats.wrong_size, kRelaxed);
    unpaired_.store(stats.unpaired, kRelaxed);
    stamps_not_increasing_.store(stats.stamps_not_increasing, kRelaxed);
    dropped_by_device_.store(stats.dropped_by_device, kRelaxed);
    device_errors_.store(stats.device_errors, kRelaxed);
    stamps_of_future_.store(stats.stamps_of_future, kRelaxed);
  }
  [[nodiscard]] SourceStats load() const {
    return {.delivered = delivered_.load(kRelaxed),
            .unreadable = unreadable_.load(kRelaxed),
            .wrong_size = wrong_size_.load(kRelaxed),
            .unpaired = unpaired_.load(kRelaxed),
            .stamps_not_increasing = stamps_not_increasing_.load(kRelaxed),
            .dropped_by_device = dropped_by_device_.load(kRelaxed),
            .device_errors = device_errors_.load(kRelaxed),
            .stamps_of_future = stamps_of_future_.load(kRelaxed)};
  }

 private:
  static constexpr auto kRelaxed = std::memory_order_relaxed;

  std::atomic<std::int64_t> delivered_ = 0;
  std::atomic<std::int64_t> unreadable_ = 0;
  std::atomic<std::int64_t> wrong_size_ = 0;
  std::atomic<std::int64_t> unpaired_ = 0;
  std::atomic<std::int64_t> stamps_not_increasing_ = 0;
  std::atomic<std::int64_t> dropped_by_device_ = 0;
  std::atomic<std::int64_t> device_errors_ = 0;
  std::atomic<std::int64_t> stamps_of_future_ = 0;
};

class PublishedCamera {
 public:
  void store(const CameraState& state) {
    exposure_ms_.store(state.exposure_ms, kRelaxed);
    gain_.store(state.gain, kRelaxed);
    rate_hz_.store(state.rate_hz, kRelaxed);
    stamp_source_.store(state.stamp_source, kRelaxed);
    stamp_uncertainty_ns_.store(state.stamp_uncertainty.count(), kRelaxed);
    last_skew_ns_.store(state.last_skew.count(), kRelaxed);
  }
  [[nodiscard]] CameraState load() const {
    return {.exposure_ms = exposure_ms_.load(kRelaxed),
            .gain = gain_.load(kRelaxed),
            .rate_hz = rate_hz_.load(kRelaxed),
            .stamp_source = stamp_source_.load(kRelaxed),
            .stamp_uncertainty = Duration{stamp_uncertainty_ns_.load(kRelaxed)},
            .last_skew = Duration{last_skew_ns_.load(kRelaxed)}};
  }

 private:
  static constexpr auto kRelaxed = std::memory_order_relaxed;

  std::atomic<double> exposure_ms_ = -1.0;
  std::atomic<double> gain_ = -1.0;
  std::atomic<double> rate_hz_ = -1.0;
  std::atomic<StampSource> stamp_source_ = StampSource::kUnknown;
  std::atomic<std::int64_t> stamp_uncertainty_ns_ = 0;
  std::atomic<std::int64_t> last_skew_ns_ = 0;
};

}  // namespace darkling
