// SPDX-License-Identifier: Apache-2.0
// From what a V4L2 buffer says of its time to the middle of its exposure.
#pragma once

#include <linux/videodev2.h>

#include "base/time.h"
#include "drivers/frame_source.h"

namespace darkling {

struct CaptureStamp {
  FrameTime middle;  // of the exposure, CLOCK_MONOTONIC
  StampSource source = StampSource::kUnknown;
  bool is_of_future = false;  // the buffer's own stamp, which the arrival stands in for
};

// V4L2 stamps the start of the exposure, or the moment when the last pixel has arrived: then the
// readout, which nobody tells, stays in the stamp. Without a monotonic stamp, or with one of zero
// or more than kMostStampAhead from the future, the time at which the buffer was taken stands in
// for the end of the frame.
// @param arrival      when the buffer was taken from the device.
// @param exposure_ms  below 0: not known, taken for 0.
[[nodiscard]] CaptureStamp stamp_capture(const v4l2_buffer& buffer, MonotonicTime arrival,
                                         double exposure_ms);

// How far the middle may be off.
// @param is_automatic  the exposure changes between two readings of it.
// @param period        of frames; 0: not known.
// @return 0 when there is no bound: arrivals come late by any load of the machine.
[[nodiscard]] Duration stamp_uncertainty(StampSource source, double exposure_ms, bool is_automatic,
                                         Duration period);

}  // namespace darkling
