// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "vo/align.h"

namespace darkling {

// Memory of separate_motions().
struct MotionScratch {
  std::span<float> squares;           // of the first motion's residuals, one a point
  std::span<std::uint8_t> by_first;   // not 0: the point goes with the first motion only
  std::span<std::uint8_t> by_second;  // … with the second only
};
[[nodiscard]] MotionScratch allocate_motion_scratch(int points_per_level, Arena& arena);

// Share of the points in the image that lie on nothing like them. In steady light at most 0.15;
// behind a body that covers a fifth of the image and moves by some pixels more than that.
[[nodiscard]] double share_of_misfits(const TemplatePoints& points,
                                      const PointResiduals& residuals);

enum class MotionCount : std::uint8_t {
  kOne,        // the points have one motion in common, as far as can be told
  kUncertain,  // a part of them may move otherwise; all are taken to move as most do
  kTwo,        // a part of them moves otherwise than the world: something passes before the cameras
};

// What is aligned to what, from where, and the memory for it.
struct MotionSearch {
  const KernelTable& kernels;
  const KeyframeTemplate& keyframe;
  const FramePyramid& frame;
  std::span<const Se3> guesses;     // of T_current_key, as for align_frame()
  const PointResiduals& residuals;  // as for align_frame()
  MotionScratch scratch;
  // There were two just now: then they need not differ by as much, nor match as well.
  bool is_expected = false;
};

// Looks for a second motion among the template's points, and lets `alignment` be of the one that is
// the world's. A body that passes before the cameras is near, and near points tell most about a
// translation: few of them outweigh all that lies behind, and the vehicle would seem to move as the
// body does, with a good score.
//
// The second motion is found by aligning without the points nearer than most, and by aligning
// without those that go with the first one; of these, the one that ranks better counts. A point
// goes with the motion it fits clearly better. The world's is the motion of more points, those of
// the one that lies behind counting for more: what covers something is before it.
//
// @param alignment  as align_frame() returned it. Afterwards its score still is of all points, but
//                   `search.residuals` count those of the other motion as not seen, and so does
//                   half of the distance: they are no reason for a keyframe in every frame, and
//                   what they cover is one for a keyframe soon.
// Cost: that of three alignments.
[[nodiscard]] MotionCount separate_motions(const MotionSearch& search, Alignment& alignment);

}  // namespace darkling
