// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "vo/align.h"
#include "vo/estimate.h"

namespace darkling {

// What is thought of an alignment, on absolute scales.
struct Judgement {
  TrackStatus status = TrackStatus::kUnknown;
  std::uint32_t reasons = kReasonNone;
  int quality = 0;
  bool is_keyframe_due = false;
};

// What is thought of an image before anything is made of it.
struct ImageJudgement {
  TrackStatus status = TrackStatus::kValid;  // kLost: not worth a keyframe or an alignment
  std::uint32_t reasons = kReasonNone;
};
[[nodiscard]] ImageJudgement judge_image(const ImageMeasure& measure);

// Whether this is what images cost that have nothing to do with the template.
[[nodiscard]] bool is_unrelated(const AlignmentScore& score);

// @param template_points       points of the keyframe's finest level.
// @param mean_inverse_depth_focal  of the same, px/m.
[[nodiscard]] Judgement judge_alignment(const Alignment& alignment, const TemplateLevel& finest,
                                        double focal_px);

}  // namespace darkling
