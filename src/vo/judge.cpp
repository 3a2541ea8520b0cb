// SPDX-License-Identifier: Apache-2.0
#include "vo/judge.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace darkling {

namespace {

// Lost: what is seen does not look like the keyframe, or too little of it is seen to say. Noise
// aligned to older noise costs 0.98 to 1.02, a covered eye 0.85 to 0.88; right poses under a light
// that halves and doubles from frame to frame 0.74 at most, in all recordings.
constexpr double kLostCost = 0.77;
constexpr double kLostVisible = 0.10;
constexpr int kLostPoints = 30;
// Degraded: still aligned, but worse than a good frame ever is. Those cost 0.59 at most, with
// photon noise of 5 to 15 electrons a pixel; steps of 3.6 m of a car 0.44 to 0.53. A bare corridor
// at 15 electrons, whose motions err by a tenth, costs 0.55 to 0.70.
constexpr double kDegradedCost = 0.60;
constexpr double kDegradedVisible = 0.25;
// A new keyframe is due when the old one is seen from another place, …
constexpr double kKeyframeVisible = 0.75;
constexpr double kKeyframeDistance = 0.36;  // that noise does not raise: see AlignmentScore
constexpr double kKeyframeBaselineOverDepth = 0.15;

// The information matrix, with translation scaled to pixels, knows its weakest direction this much
// less than its strongest before a motion counts as unobserved.
constexpr double kMinConditioning = 1e-6;

// An image as good as black, or as good as white; of the latter, half is bad enough.
constexpr double kTooDarkShare = 0.98;
constexpr double kBlindedShare = 0.9;
constexpr double kSaturatedShare = 0.5;

bool is_well_conditioned(const Matrix6& information, double px_per_m, double px_per_rad) {
  Vector6 scale;
  scale << Vector3::Constant(1.0 / px_per_m), Vector3::Constant(1.0 / px_per_rad);
  const Matrix6 scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled, Eigen::EigenvaluesOnly);
  const Vector6& values = solver.eigenvalues();
  return values[0] > kMinConditioning * values[5];
}

}  // namespace

ImageJudgement judge_image(const ImageMeasure& measure) {
  if (measure.dark_share > kTooDarkShare) return {TrackStatus::kLost, kReasonTooDark};
  if (measure.bright_share > kBlindedShare) return {TrackStatus::kLost, kReasonSaturated};
  if (measure.bright_share > kSaturatedShare) return {TrackStatus::kDegraded, kReasonSaturated};
  return {};
}

bool is_unrelated(const AlignmentScore& score) {
  return score.cost > kLostCost;
}

Judgement judge_alignment(const Alignment& alignment, const TemplateLevel& finest,
                          double focal_px) {
  const AlignmentScore& score = alignment.score;
  const double px_per_m = std::max(1e-6, static_cast<double>(finest.mean_inverse_depth_focal));
  Judgement judgement;
  const auto note = [&](bool is_so, Reason reason, TrackStatus status) {
    if (!is_so) return;
    judgement.reasons |= reason;
    judgement.status = std::max(judgement.status, status);
  };
  judgement.status = TrackStatus::kValid;
  note(score.visible_count < kLostPoints, kReasonLowTexture, TrackStatus::kLost);
  note(score.visible_fraction < kLostVisible, kReasonLowOverlap, TrackStatus::kLost);
  note(is_unrelated(score), kReasonResidualHigh, TrackStatus::kLost);
  note(score.visible_fraction < kDegradedVisible, kReasonLowOverlap, TrackStatus::kDegraded);
  note(score.cost > kDegradedCost, kReasonResidualHigh, TrackStatus::kDegraded);
  note(!alignment.has_converged, kReasonNotConverged, TrackStatus::kDegraded);
  note(!is_well_conditioned(alignment.information, px_per_m, focal_px), kReasonIllConditioned,
       TrackStatus::kDegraded);

  if (judgement.status == TrackStatus::kLost) {
    judgement.quality = -1;
    return judgement;
  }
  const double goodness =
      (1.0 - score.cost / kLostCost) * std::min(1.0, 2.0 * score.visible_fraction);
  judgement.quality = std::clamp(static_cast<int>(std::lround(100.0 * goodness)), 1, 100);
  // Baseline over the mean depth of the template, by way of the image: b/z = b · (f/z) / f.
  const double baseline_over_depth =
      alignment.T_current_key.translation().norm() * px_per_m / focal_px;
  judgement.is_keyframe_due = score.visible_fraction < kKeyframeVisible ||
                              score.distance > kKeyframeDistance ||
                              baseline_over_depth > kKeyframeBaselineOverDepth;
  return judgement;
}

}  // namespace darkling
