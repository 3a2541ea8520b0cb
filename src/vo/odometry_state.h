// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "base/arena.h"
#include "vo/align.h"
#include "vo/area_map.h"
#include "vo/carry_depth.h"
#include "vo/covariance.h"
#include "vo/frame_pyramid.h"
#include "vo/keyframe_ring.h"
#include "vo/keyframe_template.h"
#include "vo/match_stereo.h"
#include "vo/odometry.h"
#include "vo/recognise_place.h"
#include "vo/refine_window.h"
#include "vo/refinement_runner.h"
#include "vo/separate_motions.h"
#include "vo/window.h"

namespace darkling {

// Adds a reason, and that the frame is no better than `status` for it.
inline void note(Reason reason, TrackStatus status, Estimate& estimate) {
  estimate.reasons |= reason;
  estimate.status = std::max(estimate.status, status);
}

// What Odometry keeps between frames; all image and point memory is in the arena.
struct Odometry::State {
  OdometryConfig config;
  RectifiedRig rig;
  const KernelTable kernels;
  ReadClock read_clock;
  Arena arena;

  AreaMap left_map;
  AreaMap right_map;
  FramePyramid left;
  FramePyramid right;  // up to the level that is matched densely; planes only on level 0
  std::span<std::uint8_t> plane_scratch;
  StereoMatcher matcher;
  DisparityPyramid disparities;
  PointSelector selector;
  PointResiduals residuals;
  MotionScratch motions;
  PointInfluences influences;
  KeyframeTemplate keyframe;
  KeyframeRing ring;
  PointImage point_image;
  Window window;
  WindowEquations equations;

  RefinementRunner* runner;                      // null: on the thread that tracks
  bool is_refinement_due = false;                // started, or to be done, before the next frame
  bool is_refinement_news = false;               // done since the last Estimate
  Refinement refinement = Refinement::kUnknown;  // what became of the last one, and …
  Duration refinement_time = {};                 // … what it took
  std::int64_t refinement_overruns = 0;          // the next frame came first

  Se3 T_world_key;       // World here: the first rectified left camera
  Se3 T_world_previous;  // of the last frame that was measured
  // The motion that led to it; none at a start and after a frame that was lost.
  std::optional<Se3> T_before_previous;
  Se3 T_world_reported;  // of the last Estimate, measured or not, as it is thought of now
  // What refinement moved the present frame back by and the published pose has not followed yet.
  Vector6 unpublished = Vector6::Zero();
  std::int64_t previous_sequence = 0;
  std::int64_t motion_gap = 1;  // frames that T_before_previous spans
  int lost_in_a_row = 0;
  std::optional<Se3> hinted;  // T_previous_left, for the next frame only
  bool is_reseed_wanted = false;
  int reset_counter = 0;
  int track = 0;                   // in the ring; what reset_counter was when it began
  int frames_since_look = 0;       // at the right eye
  bool do_eyes_disagree = false;   // as far as the last looks could tell
  int looks_alike = 0;             // in a row
  int misplaced_looks = 0;         // in a row
  ImageMeasure previous_measure;   // of the left eye
  int frames_to_doubt = 0;         // after an image that was torn
  Sharpness usual_sharpness = {};  // along x and y; 0: not known yet
  int frames_to_watch = 0;         // for a body that passes before the cameras, and …
  int frames_of_body = 0;  // … for which one that was told from the world is taken to be there
  PoseCovariance covariance;
  bool is_reported_measured = false;  // the last Estimate's pose is what the next is relative to

  State(const OdometryConfig& config_, const RectifiedRig& rig_, const KernelTable& kernels_,
        ReadClock read_clock_, RefinementRunner* runner_, std::size_t arena_bytes)
      : config(config_),
        rig(rig_),
        kernels(kernels_),
        read_clock(read_clock_),
        arena(arena_bytes),
        runner(runner_) {}

  // Claims every buffer in `from` and fills none.
  // @return the memory of the maps, which look into it once they are filled.
  struct MapMemory {
    AreaMapMemory left;
    AreaMapMemory right;
  };
  [[nodiscard]] MapMemory allocate_buffers(Arena& from);

  ImageMeasure prepare_left(const StereoFrame& frame, Estimate& estimate);
  ImageMeasure prepare_right(const StereoFrame& frame, Estimate& estimate);
  void watch_for_bodies(std::span<const Se3> guesses, Alignment& alignment, Estimate& estimate);
  void note_repeats(const ImageMeasure& measure, Estimate& estimate);
  void note_blur(const ImageMeasure& measure, Estimate& estimate);
  void note_surprise(const Se3& T_world_left, Estimate& estimate) const;
  void compare_eyes(const Se3& T_left_key);
  void look_at_right_eye(const StereoFrame& frame, const Se3& T_left_key, Estimate& estimate);
  void report_eyes(Estimate& estimate) const;
  bool make_keyframe(const StereoFrame& frame, Estimate& estimate);
  void add_to_window(std::span<const PointSelector::Candidate> measured);
  void start_refinement();
  void refine();
  void finish_refinement();
  void start(const StereoFrame& frame, Estimate& estimate);
  void pass_over(Estimate& estimate);
  void lose(const StereoFrame& frame, Estimate& estimate);
  [[nodiscard]] std::optional<Recognition> recognise(const StereoFrame& frame, int before_track,
                                                     Estimate& estimate);
  [[nodiscard]] bool begin_track(const StereoFrame& frame, Estimate& estimate);
  [[nodiscard]] bool find_again(const StereoFrame& frame, Estimate& estimate);
  void rejoin_track(const StereoFrame& frame, Estimate& estimate);
  void accept(const Se3& T_world_left, std::int64_t sequence);
  void report(const Se3& T_world_left, Estimate& estimate);
  void report_covariance(Estimate& estimate);
  [[nodiscard]] Se3 predict(std::int64_t sequence) const;
  [[nodiscard]] bool is_doubtful(const AlignmentScore& score, std::int64_t sequence) const;
};

}  // namespace darkling
