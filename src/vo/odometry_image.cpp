// SPDX-License-Identifier: Apache-2.0
// What is made of the left eye's image, and what is seen of its faults before anything is aligned.
#include <algorithm>
#include <utility>

#include "vo/odometry_state.h"
#include "vo/stage_timer.h"

namespace darkling {

namespace {

// What tears once tears again, and only the first of such images repeats rows that were shown.
constexpr int kFramesToDoubt = 20;
// Of what the frames before had, on average over so many. Smeared over 8 px of the thumbnail, a
// frame has 0.5 to 0.66 along the smear, over 16 px 0.4 to 0.5; recordings and drives 0.69 and more
// from one frame to the next, and in a few frames of 96 px 0.52.
constexpr double kBlurredShare = 0.6;
constexpr double kSharpnessFrames = 16.0;

}  // namespace

// Brings the frame's left eye into the shape that everything else works on.
ImageMeasure Odometry::State::prepare_left(const StereoFrame& frame, Estimate& estimate) {
  ImageMeasure measure;
  {
    StageTimer timer(read_clock, estimate, Stage::kRectify);
    kernels.remap_area(left_map, frame.left, left[0].grey);
  }
  {
    StageTimer timer(read_clock, estimate, Stage::kPyramid);
    measure = build_pyramid(kernels, left);
  }
  StageTimer timer(read_clock, estimate, Stage::kPlanes);
  for (PyramidLevel& level : left) compute_planes(kernels, plane_scratch, level);
  return measure;
}

// The same image again is no camera that stands still: its noise would differ. It tells nothing,
// and nothing certain where only a part of it is new.
void Odometry::State::note_repeats(const ImageMeasure& measure, Estimate& estimate) {
  const auto [is_whole, is_partial] =
      repetition_of(measure, std::exchange(previous_measure, measure));
  if (is_whole) note(kReasonFrozen, TrackStatus::kLost, estimate);
  if (is_partial) {
    note(kReasonTorn, TrackStatus::kLost, estimate);
    frames_to_doubt = kFramesToDoubt;
  } else if (frames_to_doubt > 0) {
    note(kReasonTorn, TrackStatus::kDegraded, estimate);
    --frames_to_doubt;
  }
}

// Smeared edges are found, but less sharply, and not quite where they are.
void Odometry::State::note_blur(const ImageMeasure& measure, Estimate& estimate) {
  // On the half-sized image all pixels can be looked at: of a bare wall's few edges, some are not
  // enough.
  const int level = std::min(1, static_cast<int>(left.size()) - 1);
  const Sharpness sharpness = measure_sharpness(left[level].grey, measure.noise / (1 << level));
  bool is_blurred = false;
  for (std::size_t axis = 0; axis < sharpness.size(); ++axis) {
    const double now = sharpness[axis];
    double& usual = usual_sharpness[axis];
    if (now <= 0.0) continue;
    is_blurred |= now < kBlurredShare * usual;
    usual += usual > 0.0 ? (now - usual) / kSharpnessFrames : now;
  }
  if (is_blurred) note(kReasonBlur, TrackStatus::kDegraded, estimate);
}

}  // namespace darkling
