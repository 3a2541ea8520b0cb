// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/time.h"

namespace darkling {

// How far a stamp may be ahead of the moment when its frame was taken before nobody believes it.
// An honest one is behind, by the exposure, the readout and the transfer. Ahead are those that a
// driver calculates from counters of the device: of USB's frames, which uvcvideo goes by when it is
// told to, one takes 1 ms. As a motion's time that is 2 % of a period at 20 Hz.
inline constexpr Duration kMostStampAhead = std::chrono::milliseconds(1);

// Finds the time of frames whose own stamp is of the future: as long before their arrival as the
// last frame with a good stamp was. The arrival alone would be later by exposure, readout and
// transfer, most of a period, and the motion between two frames would get a wrong time.
// Thread: one.
class ArrivalStamps {
 public:
  // A frame with a good stamp. @param middle  of its exposure.
  // @return `middle`, or the arrival where that was earlier: what is exposed was so before, however
  //         long its exposure is said to be.
  FrameTime note(FrameTime middle, FrameTime arrival) {
    if (middle > arrival) return arrival;
    if (arrival - middle > kMostDelay) return middle;
    delay_ = arrival - middle;
    is_known_ = true;
    return middle;
  }
  // A frame without. @param otherwise  when no frame had a good one so far.
  [[nodiscard]] FrameTime estimate(FrameTime arrival, FrameTime otherwise) const {
    return is_known_ ? arrival - delay_ : otherwise;
  }

 private:
  // No frame takes as long: a stamp from before then is wrong in its own way.
  static constexpr Duration kMostDelay = std::chrono::seconds(1);

  Duration delay_ = Duration::zero();  // from the middle of the exposure to the arrival
  bool is_known_ = false;
};

}  // namespace darkling
