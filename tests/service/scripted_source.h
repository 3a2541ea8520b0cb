// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "drivers/frame_source.h"
#include "platform/clocks.h"
#include "support/synthetic_run.h"

namespace darkling::test {

// A camera that a test plays with: frames of a scene, to and fro, at 50 Hz, and every fault that a
// camera can have, on demand.
// Thread: the switches from any.
class ScriptedSource final : public FrameSource {
 public:
  explicit ScriptedSource(const SyntheticRun& run) : run_(run) {}

  std::atomic<bool> is_absent = false;             // start() fails, wait_next() loses the device
  std::atomic<bool> is_hanging = false;            // wait_next() does not return
  std::atomic<bool> is_silent = false;             // nothing arrives
  std::atomic<bool> has_bad_frames = false;        // each pair is unusable
  std::atomic<std::int64_t> stamps_of_future = 0;  // that it says it had
  std::atomic<std::int64_t> last_frame = -1;       // the source ends there; -1: never
  std::atomic<int> starts = 0;
  std::atomic<int> stops = 0;
  std::atomic<int> leases = 0;       // that are out
  std::atomic<int> most_leases = 0;  // at stop(): must be 0

  Result<void> start() override {
    if (is_absent) return failure(ExitCode::kDeviceUnavailable, "no such camera");
    ++starts;
    return {};
  }

  WaitResult wait_next(Duration timeout) override {
    while (is_hanging) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (is_absent) return {.status = WaitStatus::kDeviceLost};
    if (last_frame >= 0 && next_ > last_frame) return {.status = WaitStatus::kEndOfSource};
    if (is_silent) {
      std::this_thread::sleep_for(timeout);
      return {.status = WaitStatus::kTimeout};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const FrameTime stamp = frame_time_from_ns(to_ns(read_monotonic_clock()));
    const std::int64_t sequence = next_++;
    if (has_bad_frames) {
      return {.status = WaitStatus::kBadFrame,
              .fault = FrameFault::kUnpaired,
              .sequence = sequence,
              .stamp = stamp};
    }
    const auto period = static_cast<std::int64_t>(2 * (run_.frames.size() - 1));
    const std::int64_t phase = sequence % period;
    StereoFrame frame =
        run_.frames[static_cast<std::size_t>(std::min(phase, period - phase))].at(sequence);
    frame.stamp = stamp;
    ++leases;
    WaitResult result;
    result.status = WaitStatus::kFrame;
    result.lease = FrameLease(
        frame, [](void* self, int) { --static_cast<ScriptedSource*>(self)->leases; }, this, 0);
    return result;
  }

  void stop() override {
    ++stops;
    most_leases = std::max(most_leases.load(), leases.load());
  }
  [[nodiscard]] SourceStats stats() const override {
    return {.stamps_of_future = stamps_of_future};
  }

 private:
  const SyntheticRun& run_;
  std::int64_t next_ = 0;
};

}  // namespace darkling::test
