// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/stereo_frame.h"
#include "base/time.h"

namespace darkling {

// A frame on loan: its pixels stay valid until the lease goes, which gives the buffer back to the
// source. Move-only.
class FrameLease {
 public:
  using GiveBack = void (*)(void* source, int slot);

  FrameLease() = default;
  FrameLease(const StereoFrame& frame, GiveBack give_back, void* source, int slot)
      : frame_(frame), give_back_(give_back), source_(source), slot_(slot) {}
  FrameLease(FrameLease&& other) noexcept { swap(other); }
  FrameLease& operator=(FrameLease&& other) noexcept {
    FrameLease(std::move(other)).swap(*this);
    return *this;
  }
  ~FrameLease() {
    if (give_back_ != nullptr) give_back_(source_, slot_);
  }

  [[nodiscard]] const StereoFrame& frame() const { return frame_; }
  // What was on another clock, or is played back, is labelled anew.
  void relabel(std::int64_t sequence, FrameTime stamp) {
    frame_.sequence = sequence;
    frame_.stamp = stamp;
  }
  [[nodiscard]] bool is_held() const { return give_back_ != nullptr; }

 private:
  void swap(FrameLease& other) noexcept {
    std::swap(frame_, other.frame_);
    std::swap(give_back_, other.give_back_);
    std::swap(source_, other.source_);
    std::swap(slot_, other.slot_);
  }

  StereoFrame frame_;
  GiveBack give_back_ = nullptr;
  void* source_ = nullptr;
  int slot_ = 0;
};

enum class WaitStatus {
  kUnknown = 0,
  kFrame,        // `lease` holds a pair
  kBadFrame,     // the pair at `sequence` was lost or unusable; `fault` says why; go on
  kTimeout,      // nothing within the time given
  kEndOfSource,  // a recording is over
  kDeviceLost,   // stop() and start() again
};

enum class FrameFault {
  kNone = 0,
  kUnreadable,  // file absent, truncated or corrupt; buffer marked bad or half full
  kWrongSize,   // not the size the calibration is for, or the eyes differ
  kUnpaired,    // one eye without the other
};

struct [[nodiscard]] WaitResult {
  WaitStatus status = WaitStatus::kUnknown;
  FrameFault fault = FrameFault::kNone;  // with kBadFrame
  std::int64_t sequence = 0;             // with kBadFrame: the pair that is missing
  FrameTime stamp = {};                  // with kBadFrame: when it was taken
  FrameLease lease = {};                 // with kFrame
};

// Counts since start(); every pair of the source is in exactly one of the first four.
struct SourceStats {
  std::int64_t delivered = 0;
  std::int64_t unreadable = 0;
  std::int64_t wrong_size = 0;
  std::int64_t unpaired = 0;
  // Of the delivered: stamps that repeat or go back. Tracking goes by sequence and does not mind.
  std::int64_t stamps_not_increasing = 0;
  // Not in any of the above, because the device never handed them out: gaps in its own numbers.
  // Of two devices, frames of either; such a frame's partner makes its pair an unpaired one.
  std::int64_t dropped_by_device = 0;
  std::int64_t device_errors = 0;  // buffers that the device marked as bad or filled too little
  // Buffers that a device said to be of a time still to come; they are stamped by their arrival.
  std::int64_t stamps_of_future = 0;
};

// Where a camera's stamps come from, best last.
enum class StampSource { kUnknown = 0, kArrival, kEndOfFrame, kStartOfExposure };

// How a live camera says it is set: read back, not what was asked for. Recordings know nothing.
struct CameraState {
  double exposure_ms = -1.0;  // -1: not known
  double gain = -1.0;         // in the device's own units; -1: not known
  double rate_hz = -1.0;      // frames a second; -1: not known
  StampSource stamp_source = StampSource::kUnknown;
  Duration stamp_uncertainty = Duration::zero();  // 0: not known
  Duration last_skew = Duration::zero();          // right minus left of the last pair
};

// Where stereo frames come from: a camera driver, a recording, a rendered scene.
// Thread: one thread at a time; leases may be given back from another.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  // Opens devices or files and claims all memory. May be called again after stop().
  // @return kNoInput, kBadInput or kDeviceUnavailable with what was missing where.
  virtual Result<void> start() = 0;
  // The next pair, waiting for at most `timeout`; recordings never wait.
  virtual WaitResult wait_next(Duration timeout) = 0;
  // Releases what start() claimed. @pre no lease is held.
  virtual void stop() = 0;
  // What is not as asked for, but can be lived with, a sentence each; after kDeviceLost, why as
  // well. Thread: the one that starts.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
  // Thread: any, while frames are waited for.
  [[nodiscard]] virtual SourceStats stats() const = 0;
  [[nodiscard]] virtual CameraState camera_state() const { return {}; }
};

}  // namespace darkling
