// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/time.h"
#include "vo/estimate.h"

namespace darkling {

// What the service is doing, as status_t says it.
enum class ServiceState : std::int8_t {
  kUnknown = 0,
  kInit,      // no motion measured yet
  kTracking,  // motion is measured
  kDegraded,  // measured, worse than usual
  kLost,      // frames arrive, motion is not measured
  kNoCamera,  // no frames arrive
  kFault,     // a thread of the service hangs
};
inline constexpr int kServiceStateCount = 7;
[[nodiscard]] const char* name_of(ServiceState state);
// The state of a status_t; kUnknown for numbers that this version does not know.
[[nodiscard]] ServiceState state_from_message(std::int8_t state);

// Reasons of the service itself, beside those of an Estimate.
enum ServiceReason : std::uint32_t {
  kReasonNoFrames = 1u << 24,      // the camera is not open, or delivers nothing
  kReasonLate = 1u << 25,          // pairs were passed over: the processor is too busy
  kReasonClockStepped = 1u << 26,  // the wall clock; stamps by CLOCK_MONOTONIC go on as they were
  kReasonNotPublished = 1u << 27,  // no network, or it refuses
  kReasonRecordingFailed = 1u << 28,  // stopped by an error, or pairs were left out
};

// "residual_high", "late"; a bit without a name is its number: "0x800000".
[[nodiscard]] std::vector<std::string> names_of_reasons(std::uint32_t reasons);
// "residual_high,late"; "none".
[[nodiscard]] std::string describe_reasons(std::uint32_t reasons);

// Decides from what arrives, and from what does not, how the service is.
// Thread: one.
class Health {
 public:
  // @param period  between frames, as configured.
  Health(MonotonicTime now, Duration period);

  void observe(const Estimate& estimate, MonotonicTime now);
  void observe(std::uint32_t reasons) { reasons_ |= reasons; }

  enum class Camera { kOpening, kOpen, kAbsent };
  // @param are_threads_alive  all heartbeats are fresh.
  [[nodiscard]] ServiceState judge(MonotonicTime now, Camera camera, bool are_threads_alive);

  // Of all frames since the last call.
  [[nodiscard]] std::uint32_t take_reasons();

 private:
  MonotonicTime last_frame_at_;
  Duration silence_;  // after which the camera counts as gone
  TrackStatus last_status_ = TrackStatus::kUnknown;
  std::uint32_t reasons_ = 0;
};

}  // namespace darkling
