// SPDX-License-Identifier: Apache-2.0
// From what libcamera says of a frame's time to the middle of its exposure.
#pragma once

#include "base/time.h"
#include "drivers/frame_source.h"
#include "drivers/libcamera/completed_frames.h"

namespace darkling {

struct SensorStamp {
  FrameTime middle;  // of the exposure, CLOCK_MONOTONIC
  StampSource source = StampSource::kUnknown;
  bool is_of_future = false;  // what the frame says, which the arrival stands in for
};

// libcamera's SensorTimestamp is documented as when the first row is exposed, by CLOCK_BOOTTIME;
// its handlers hand on what V4L2 says, by CLOCK_MONOTONIC. The two differ by the time that the
// machine was suspended. The stamp is taken for monotonic when it is in the past then, else for
// boot time; what is in the future by both, by more than kMostStampAhead, gives way to the arrival,
// as the frame's end.
// @param boot_ahead   CLOCK_BOOTTIME minus CLOCK_MONOTONIC.
// @param exposure_ms  below 0: not known, taken for 0.
[[nodiscard]] SensorStamp stamp_frame(const CompletedFrame& frame, Duration boot_ahead,
                                      double exposure_ms);

// How far the middle may be off. Handlers differ in whether they stamp the start of the first row's
// exposure or its end, when the readout starts: the whole exposure.
// @param period  of frames; 0: not known.
// @return 0 when there is no bound.
[[nodiscard]] Duration sensor_stamp_uncertainty(StampSource source, double exposure_ms,
                                                Duration period);

}  // namespace darkling
