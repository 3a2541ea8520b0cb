// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/time.h"
#include "geometry/se3.h"

namespace darkling {

enum class TrackStatus : std::uint8_t {
  kUnknown = 0,
  kValid,     // the motion is measured
  kDegraded,  // measured, but something in `reasons` made it worse than usual
  kLost,      // not measured: the pose is held or predicted, or that of a place seen before
};

// Why a frame is not simply kValid: bits, any number of them at once.
enum Reason : std::uint32_t {
  kReasonNone = 0,
  kReasonLowTexture = 1u << 0,      // too few points to align
  kReasonLowOverlap = 1u << 1,      // the template has left the image
  kReasonNotConverged = 1u << 2,    // iteration bound reached with the step still large
  kReasonIllConditioned = 1u << 3,  // some direction of motion is not observed
  kReasonResidualHigh = 1u << 4,    // aligned, but the images do not match
  kReasonDropped = 1u << 5,         // no usable pair: lost or unreadable
  kReasonNoDepth = 1u << 6,         // stereo found no depth to track by
  kReasonEyesSwapped = 1u << 7,     // the left image is the right camera's
  kReasonTooDark = 1u << 8,         // an eye sees next to nothing
  kReasonSaturated = 1u << 9,       // an eye is blinded: most of its image is clipped
  kReasonFrozen = 1u << 10,         // the same image again and again
  kReasonEyesDisagree = 1u << 11,   // the right eye does not see what the left one does
  kReasonCalibSuspect = 1u << 12,   // the eyes agree, but not on the same height
  kReasonMovingBody = 1u << 13,     // a good part of what is seen moves otherwise than the rest
  kReasonTorn = 1u << 14,           // part of the image is of the frame before, or was just now
  kReasonUnsynced = 1u << 15,  // no pair: an eye alone, the other one's image too far off in time
  kReasonBlur = 1u << 16,      // far less sharp than the frames before
  kReasonStepTooLarge = 1u << 17,  // far from where the motion before would have led
};
inline constexpr int kReasonCount = 18;
inline constexpr std::array<const char*, kReasonCount> kReasonNames = {
    "low_texture", "low_overlap",   "not_converged", "ill_conditioned", "residual_high",
    "dropped",     "no_depth",      "eyes_swapped",  "too_dark",        "saturated",
    "frozen",      "eyes_disagree", "calib_suspect", "moving_body",     "torn",
    "unsynced",    "blur",          "step_too_large"};

// The stages of a frame, in order: what `stage_us` of the statistics is keyed by.
enum class Stage : std::uint8_t { kRectify, kPyramid, kPlanes, kTrack, kStereo, kSelect, kRefine };
inline constexpr int kStageCount = 7;
inline constexpr std::array<const char*, kStageCount> kStageNames = {
    "rectify", "pyramid", "planes", "track", "stereo", "select", "refine"};

// What became of one refinement of the window.
enum class Refinement : std::uint8_t {
  kUnknown = 0,
  kApplied,
  kTooFewPoints,    // refused: too little of the window is seen in the newest keyframe …
  kDisagreement,    // … or what is seen there does not look as it should: its pose is wrong
  kIllConditioned,  // refused: some motion of some keyframe is not observed
  kStepTooLarge,    // refused: a keyframe would move further than tracking can have erred
  kNoGain,          // nothing to do: no step lowers the cost
};
inline constexpr int kRefinementCount = 7;
inline constexpr std::array<const char*, kRefinementCount> kRefinementNames = {
    "unknown",         "applied",        "too_few_points", "disagreement",
    "ill_conditioned", "step_too_large", "no_gain"};

// What one frame taught: one per input frame, whatever happened to it.
struct Estimate {
  std::int64_t sequence = 0;
  FrameTime stamp;
  TrackStatus status = TrackStatus::kUnknown;
  std::uint32_t reasons = kReasonNone;  // Reason bits
  int quality = 0;                      // -1 failed, 0 unknown, 1…100
  bool is_keyframe = false;             // became the template of the frames that follow
  int reset_counter = 0;                // how often the pose jumped or the track was broken
  Se3 T_world_left;                     // accumulated; while kLost see there
  Se3 T_world_body;
  // Motion since the previous Estimate, as measured. Poses follow a refinement of the keyframes
  // behind them little by little; that is no motion, and not in here.
  Se3 T_previous_body;
  // Covariances of right perturbations, T = T_true exp(ξ), ξ = (translation, rotation) in Body: m²,
  // m·rad, rad². Not known is 9999 on the diagonal and 0 beside it: while kLost, of the motion, and
  // of the pose unless a place was recognised; of the motion also when the Estimate before was not
  // measured. The pose's counts from the first keyframe, or from where tracking began anew.
  Matrix6 cov_previous_body = Matrix6::Zero();
  Matrix6 cov_world_body = Matrix6::Zero();
  int point_count = 0;            // template points of the finest level seen in this frame
  double visible_fraction = 0.0;  // of the template points, 0…1
  double cost = 0.0;              // mean truncated descriptor distance, 0…1, absolute
  int iterations = 0;             // of alignment, all levels
  // Of the keyframe before this frame, when it was refined since the last Estimate.
  Refinement refinement = Refinement::kUnknown;
  std::array<Duration, kStageCount> stage_times = {};
};

}  // namespace darkling
