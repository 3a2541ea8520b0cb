// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/sensor_stamp.h"

#include <optional>

#include "drivers/camera/arrival_stamps.h"
#include "drivers/camera/half_exposure.h"

namespace darkling {

namespace {

constexpr std::int64_t kLastStamp_ns = 1LL << 62;  // 146 years

// @pre the frame says one. @return nothing: it is of the future.
std::optional<FrameTime> monotonic_stamp(const CompletedFrame& frame, FrameTime arrival,
                                         Duration boot_ahead) {
  if (frame.stamp_ns > kLastStamp_ns) return std::nullopt;
  const FrameTime as_said = frame_time_from_ns(frame.stamp_ns);
  if (as_said <= arrival + kMostStampAhead) return as_said;
  const FrameTime since_boot = as_said - boot_ahead;
  if (since_boot <= arrival + kMostStampAhead) return since_boot;
  return std::nullopt;
}

}  // namespace

SensorStamp stamp_frame(const CompletedFrame& frame, Duration boot_ahead, double exposure_ms) {
  const FrameTime arrived = frame_time_from_ns(to_ns(frame.arrival));
  const Duration half = half_exposure(exposure_ms);
  const bool has_stamp = frame.stamp_ns > 0;
  const auto stamp = has_stamp ? monotonic_stamp(frame, arrived, boot_ahead) : std::nullopt;
  if (!stamp) {
    return {.middle = arrived - half, .source = StampSource::kArrival, .is_of_future = has_stamp};
  }
  if (frame.is_of_sensor) {
    return {.middle = *stamp + half, .source = StampSource::kStartOfExposure};
  }
  return {.middle = *stamp - half, .source = StampSource::kEndOfFrame};
}

Duration sensor_stamp_uncertainty(StampSource source, double exposure_ms, Duration period) {
  switch (source) {
    case StampSource::kStartOfExposure:
      return exposure_ms < 0.0 ? period : 2 * half_exposure(exposure_ms);
    case StampSource::kEndOfFrame:
      return period;  // the readout takes at most that long
    case StampSource::kArrival:
    case StampSource::kUnknown:
      break;
  }
  return Duration::zero();
}

}  // namespace darkling
