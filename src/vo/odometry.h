// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "base/arena.h"
#include "base/result.h"
#include "base/stereo_frame.h"
#include "base/time.h"
#include "geometry/stereo_rig.h"
#include "kernels/kernel_table.h"
#include "vo/estimate.h"
#include "vo/odometry_config.h"
#include "vo/refinement_runner.h"

namespace darkling {

// Stereo odometry of one rig: frames in, one Estimate each out. All memory is claimed by create().
// Thread: one thread at a time. Same frames, same estimates, byte for byte.
class Odometry {
 public:
  using ReadClock = MonotonicTime (*)();

  // @param read_clock  times the stages; results do not depend on it.
  // @param runner      computes refinements, and outlives the odometry; without one they are
  //                    computed by finish_refinement(), or at the start of track() or skip().
  // @return kConfiguration when the rig makes no sense or the thumbnail exceeds vo/limits.h.
  static Result<std::unique_ptr<Odometry>> create(const OdometryConfig& config,
                                                  const StereoRig& rig, const KernelTable& kernels,
                                                  ReadClock read_clock,
                                                  RefinementRunner* runner = nullptr);
  ~Odometry();

  // @pre the frame's images have the sizes of the rig's cameras.
  [[nodiscard]] Estimate track(const StereoFrame& frame);

  // Says that the pair at `sequence` is missing: the pose is predicted, status kLost. The next
  // track() takes the gap into account.
  // @param reason  kReasonDropped or kReasonUnsynced.
  [[nodiscard]] Estimate skip(std::int64_t sequence, FrameTime stamp, Reason reason);

  // Adds to the guesses that the next track() starts from.
  // @param T_previous_body  motion of Body since the last frame that was measured.
  void hint(const Se3& T_previous_body);
  // Makes the next frame that is measured a keyframe, whether or not one is due.
  void reseed();
  // Forgets everything but the count of resets, which grows: the next frame starts a new track at
  // the origin.
  void reset();

  // Completes the refinement that the last frame left, if any: what track() and skip() begin with,
  // for callers that have time between frames.
  void finish_refinement();

  [[nodiscard]] const RectifiedRig& rig() const;
  [[nodiscard]] std::size_t arena_bytes() const;
  // How often the runner was still at work when the next frame came.
  [[nodiscard]] std::int64_t refinement_overruns() const;

  // Asks `arena` for every buffer that create() claims for a thumbnail of this size, and fills
  // none.
  // @pre check_limits() finds nothing wrong.
  static void claim_buffers(const OdometryConfig& config, int width_px, int height_px,
                            Arena& arena);
  // Of the object itself, which is not in the arena.
  [[nodiscard]] static std::size_t state_bytes();

 private:
  struct State;
  explicit Odometry(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace darkling
