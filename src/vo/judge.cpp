// SPDX-License-Identifier: Apache-2.0
#include "vo/judge.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace darkling {

namespace {

// Lost: what is seen does not look like the keyframe, or too little of it is seen to say. Views
// that have nothing to do with each other end at a cost of 0.80 to 0.91; the hardest true alignment
// seen, steps of 6 m between frames of a car, at 0.59.
constexpr double kLostCost = 0.70;
constexpr double kLostVisible = 0.10;
constexpr int kLostPoints = 30;
// Degraded: still aligned, but worse than a good frame ever is: those end at 0.45 at most, and
// fresh noise aligned to older noise at 0.51 to 0.60 (880 frames, 96 and 160 px).
constexpr double kDegradedCost = 0.50;
constexpr double kDegradedVisible = 0.25;
// A new keyframe is due when the old one is seen from another place, …
constexpr double kKeyframeVisible = 0.75;
constexpr double kKeyframeCost = 0.36;
constexpr double kKeyframeBaselineOverDepth = 0.15;

// The information matrix, with translation scaled to pixels, knows its weakest direction this much
// less than its strongest before a motion counts as unobserved.
constexpr double kMinConditioning = 1e-6;

bool is_well_conditioned(const Matrix6& information, double px_per_m, double px_per_rad) {
  Vector6 scale;
  scale << Vector3::Constant(1.0 / px_per_m), Vector3::Constant(1.0 / px_per_rad);
  const Matrix6 scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled, Eigen::EigenvaluesOnly);
  const Vector6& values = solver.eigenvalues();
  return values[0] > kMinConditioning * values[5];
}

}  // namespace

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
  note(score.cost > kLostCost, kReasonResidualHigh, TrackStatus::kLost);
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
                              score.cost > kKeyframeCost ||
                              baseline_over_depth > kKeyframeBaselineOverDepth;
  return judgement;
}

}  // namespace darkling
