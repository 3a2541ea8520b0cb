// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "vo/align.h"
#include "vo/keyframe_ring.h"

namespace darkling {

inline constexpr float kNothingAlike = std::numeric_limits<float>::infinity();

// How a keyframe of the ring may lie on a frame.
struct RotationMatch {
  const RingKeyframe* keyframe = nullptr;
  Se3 T_current_key;           // a rotation
  float rank = kNothingAlike;  // as AlignmentScore::rank(): low is alike
};

// Finds for each keyframe the rotation that shows its points most alike on the coarsest level of a
// frame, as if all were far away: yaw and pitch on a grid, as far as enough of the image may stay
// in view. Roll and nearness are left to the alignment.
// @param matches  with their keyframes; the rest is filled in.
void search_rotations(const KernelTable& kernels, const FramePyramid& frame,
                      const PointResiduals& scratch, std::span<RotationMatch> matches);

// A frame's alignment to a keyframe of the ring.
struct Recognition {
  const RingKeyframe* keyframe = nullptr;
  Alignment alignment;
};

// Finds the keyframe of the ring near which a frame was taken, and the frame's pose relative to it:
// a search over rotations for each keyframe, then alignments to the three that look most alike. Of
// those that are beyond doubt the one of the oldest track is taken, and of that track the one of
// the lowest cost; none, when two of one track do not say the same.
//
// @param before_track  keyframes of this track and later ones are left out.
// @return nothing when no place is recognised.
// Exactness: the same bits with every kernel table.
// Cost: bounded by the ring; 4 ms at 320x240 with AVX2, most of it the search.
[[nodiscard]] std::optional<Recognition> recognise_place(const KernelTable& kernels,
                                                         const KeyframeRing& ring, int before_track,
                                                         const FramePyramid& frame,
                                                         const PointResiduals& scratch);

// Whether an alignment is beyond doubt: a wrong pose is worse than none.
[[nodiscard]] bool is_beyond_doubt(const Alignment& alignment, const TemplateLevel& finest,
                                   double focal_px);

}  // namespace darkling
