// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "drivers/frame_source.h"
#include "drivers/synthetic/synthetic_rig.h"
#include "drivers/synthetic/synthetic_spec.h"
#include "geometry/stereo_rig.h"

namespace darkling {

// Rendered stereo of a scene with exact truth. The same specification gives the same pixels and
// poses on every run, whatever the number of threads.
// Frames are rendered ahead by threads of its own; wait_next() waits for the next one whatever the
// timeout, and times out only when all buffers are on lease.
class SyntheticSource : public FrameSource {
 public:
  // @param threads  that render; 0 = one a core.
  // @return kUsage when the specification is out of range.
  static Result<std::unique_ptr<SyntheticSource>> create(const SyntheticSpec& spec,
                                                         int threads = 0);
  ~SyntheticSource() override;

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] SourceStats stats() const override;

  [[nodiscard]] const SyntheticSpec& spec() const;
  // The cameras as they are; frames are unrectified when the rig has distortion or roll.
  [[nodiscard]] const StereoRig& rig() const;
  // Mid-exposure of both images: a fixed epoch plus the frame's number over the rate.
  [[nodiscard]] FrameTime stamp(int frame) const;
  // Body at the stamp of `frame` in the Body frame of frame 0: exact, by definition.
  [[nodiscard]] Se3 T_world_body(int frame) const;

 private:
  struct State;
  explicit SyntheticSource(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace darkling
