// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "vo/frame_pyramid.h"
#include "vo/keyframe_template.h"

namespace darkling {

// Finds the whole disparity of each candidate of level 0 that was matched on a coarser level: the
// best agreement of a patch of census codes within a pixel of that level. Nothing to do where
// level 0 itself was matched.
// @pre level 0 of both eyes, with codes; candidates at least 2 px from the border.
void search_disparities(const KernelTable& kernels, const PyramidLevel& left,
                        const PyramidLevel& right, int matched_level,
                        std::span<PointSelector::Candidate> candidates);

// Moves each candidate's disparity to where the bit-planes of a small patch agree best between the
// eyes: Gauss-Newton in one unknown. Semi-global matching decides which pixel; this decides where
// in it, without the pull towards whole pixels that interpolated matching costs have.
// Candidates whose patches do not agree are given kNoDisparity, the others a variance from how well
// they do.
// @pre level 0 of both eyes, with planes; candidates at least 2 px from the border.
void refine_disparities(const KernelTable& kernels, const PyramidLevel& left,
                        const PyramidLevel& right, std::span<PointSelector::Candidate> candidates);

// Moves the candidates with a disparity to the front, in their order, and returns them.
[[nodiscard]] std::span<PointSelector::Candidate> drop_unknown(
    std::span<PointSelector::Candidate> candidates);

}  // namespace darkling
