// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/capture_stamp.h"

#include <algorithm>
#include <optional>

#include "drivers/camera/arrival_stamps.h"
#include "drivers/camera/half_exposure.h"

namespace darkling {

namespace {

constexpr std::int64_t kLastSecond = 1LL << 33;  // 272 years; nanoseconds still fit 64 bits
constexpr Duration kExposureStep = std::chrono::microseconds(100);  // V4L2's unit

std::optional<FrameTime> monotonic_stamp(const v4l2_buffer& buffer) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return std::nullopt;
  }
  const std::int64_t seconds = std::min<std::int64_t>(buffer.timestamp.tv_sec, kLastSecond);
  const std::int64_t microseconds = buffer.timestamp.tv_usec;
  if (seconds < 0 || microseconds < 0 || microseconds >= 1'000'000) {
    return std::nullopt;
  }
  const FrameTime stamp = frame_time_from_ns(seconds * 1'000'000'000 + microseconds * 1000);
  if (stamp == FrameTime{}) return std::nullopt;
  return stamp;
}

}  // namespace

CaptureStamp stamp_capture(const v4l2_buffer& buffer, MonotonicTime arrival, double exposure_ms) {
  const FrameTime arrived = frame_time_from_ns(to_ns(arrival));
  const Duration half = half_exposure(exposure_ms);
  const auto stamp = monotonic_stamp(buffer);
  const bool is_of_future = stamp && *stamp > arrived + kMostStampAhead;
  if (!stamp || is_of_future) {
    return {
        .middle = arrived - half, .source = StampSource::kArrival, .is_of_future = is_of_future};
  }
  const bool is_start =
      (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  if (is_start) return {.middle = *stamp + half, .source = StampSource::kStartOfExposure};
  return {.middle = *stamp - half, .source = StampSource::kEndOfFrame};
}

Duration stamp_uncertainty(StampSource source, double exposure_ms, bool is_automatic,
                           Duration period) {
  switch (source) {
    case StampSource::kStartOfExposure:
      if (exposure_ms < 0.0) return period / 2;
      return is_automatic ? std::max(half_exposure(exposure_ms), kExposureStep / 2)
                          : kExposureStep / 2;
    case StampSource::kEndOfFrame:
      return period;  // the readout takes at most that long
    case StampSource::kArrival:
    case StampSource::kUnknown:
      break;
  }
  return Duration::zero();
}

}  // namespace darkling
