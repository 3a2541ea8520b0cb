// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// Where refinements are computed. What one yields does not depend on it, nor when it is applied:
// before the frame that follows its keyframe.
// Thread: start() and wait() from the thread that tracks.
class RefinementRunner {
 public:
  virtual ~RefinementRunner() = default;
  using Job = void (*)(void* context);
  // @pre what was started before has been waited for.
  virtual void start(Job job, void* context) = 0;
  // Returns when the job is done.
  // @return whether it was done already.
  virtual bool wait() = 0;
};

}  // namespace darkling
