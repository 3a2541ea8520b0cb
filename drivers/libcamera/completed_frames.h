// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>

#include "base/fixed_vector.h"
#include "base/time.h"

namespace darkling {

// What libcamera says of a request that it has completed.
struct CompletedFrame {
  int buffer = -1;
  bool is_whole = false;       // not marked as bad, and filled
  std::uint32_t sequence = 0;  // as the device counts
  std::int64_t stamp_ns = 0;   // 0: none
  bool is_of_sensor = false;   // whether that is when the exposure began, else of the buffer
  double exposure_ms = -1.0;   // -1: not said
  double gain = -1.0;          // -1: not said
  Duration period = Duration::zero();  // 0: not said
  MonotonicTime arrival = {};
};

// Where the thread that wants frames waits for those of several cameras.
struct Doorbell {
  std::mutex mutex;
  std::condition_variable rung;
};

// The frames of one camera between libcamera's thread, which brings them, and ours.
// Thread: any.
class CompletedFrames {
 public:
  // How many buffers a camera may have; each is here once at most.
  static constexpr std::size_t kCapacity = 8;

  explicit CompletedFrames(Doorbell& bell) : bell_(bell) {}

  // A frame beyond the capacity would be of a buffer that completed twice, and is dropped.
  void push(const CompletedFrame& frame);
  // The camera is gone for good.
  void disconnect();

  // The oldest.
  std::optional<CompletedFrame> pop();
  [[nodiscard]] bool is_disconnected() const;

  // Waits until one of `wanted`, all of this bell, has a frame or is disconnected; null ones are
  // passed over.
  static void wait_for_any(Doorbell& bell, std::span<const CompletedFrames* const> wanted,
                           Duration timeout);

 private:
  Doorbell& bell_;
  FixedVector<CompletedFrame, kCapacity> frames_;  // by the bell's mutex
  bool is_disconnected_ = false;                   // by the bell's mutex
};

}  // namespace darkling
