// SPDX-License-Identifier: Apache-2.0
#include "vo/align.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

namespace darkling {

namespace {

// Descriptor distance, root mean square over the planes in 0…255, at which a point counts as not
// matching at all. Two unrelated neighbourhoods are about 110 apart.
constexpr double kCostTruncation = 80.0;
constexpr int kMaxIterations = 30;         // a level
constexpr double kConvergedStepPx = 0.01;  // of the level's pixels
constexpr int kMinPoints = 12;             // twice the unknowns; fewer do not constrain a motion

PointWarp make_warp(const Se3& T_current_key, const PyramidLevel& level) {
  PointWarp warp;
  const Matrix3 R = T_current_key.R();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) warp.A[3 * i + j] = static_cast<float>(R(i, j));
    warp.a[i] = static_cast<float>(T_current_key.translation()[i]);
  }
  warp.focal_px = static_cast<float>(level.focal_px);
  warp.cx = static_cast<float>(level.cx);
  warp.cy = static_cast<float>(level.cy);
  return warp;
}

AlignmentScore score_residuals(std::span<const PointResidual> residuals) {
  double sum = 0.0;
  int visible = 0;
  for (const PointResidual& r : residuals) {
    if (r.distance < 0.0f) continue;
    sum += std::min(static_cast<double>(r.distance), kCostTruncation);
    ++visible;
  }
  AlignmentScore score;
  score.visible_count = visible;
  if (visible == 0) return score;
  score.cost = sum / (kCostTruncation * visible);
  score.visible_fraction = static_cast<double>(visible) / static_cast<double>(residuals.size());
  return score;
}

// The median distance of the visible points from a histogram of one grey level a bin.
float median_distance(std::span<const PointResidual> residuals, int visible) {
  std::array<int, 257> histogram = {};
  for (const PointResidual& r : residuals) {
    if (r.distance >= 0.0f) ++histogram[static_cast<int>(r.distance)];
  }
  int below = 0;
  int bin = 0;
  while (2 * (below + histogram[bin]) < visible) below += histogram[bin++];
  const int in_bin = std::max(histogram[bin], 1);
  return static_cast<float>(bin) +
         static_cast<float>(0.5 * visible - below) / static_cast<float>(in_bin);
}

struct NormalEquations {
  Matrix6 H = Matrix6::Zero();
  Vector6 g = Vector6::Zero();
};

// Adds one point to the normal equations. With p = (x, y, f)/s in metres, s = f/z, the derivative
// of its pixel by a right perturbation (ρ, θ) of T_current_key, at the identity, is
//   ∂u = [s, 0, -x s/f, -x y/f, f + x²/f, -y],   ∂v = [0, s, -y s/f, -(f + y²/f), x y/f, x].
void add_point(const TemplatePoint& point, const PointResidual& residual, double weight, double f,
               NormalEquations& sum) {
  const double x = static_cast<double>(point.x);
  const double y = static_cast<double>(point.y);
  const double s = static_cast<double>(point.inverse_depth_focal);
  Vector6 Ju;
  Vector6 Jv;
  Ju << s, 0.0, -x * s / f, -x * y / f, f + x * x / f, -y;
  Jv << 0.0, s, -y * s / f, -(f + y * y / f), x * y / f, x;
  const Vector6 SJu = weight * (double(point.Sxx) * Ju + double(point.Sxy) * Jv);
  const Vector6 SJv = weight * (double(point.Sxy) * Ju + double(point.Syy) * Jv);
  sum.H.noalias() += Ju * SJu.transpose() + Jv * SJv.transpose();
  sum.g += weight * (double(residual.bx) * Ju + double(residual.by) * Jv);
}

// One robust weight a point, from its descriptor distance: Geman and McClure's, on the scale of the
// median, so that points that do not match have no say. Against Cauchy's of the same efficiency the
// drift of a car fell by a tenth (steps of 3.6 m: by a fifth); RPE of a drone rose by 2 to 5 %.
NormalEquations accumulate(const TemplateLevel& level, std::span<const PointResidual> residuals,
                           int visible, double focal_px) {
  const double scale =
      std::max(1.0, 0.8 * static_cast<double>(median_distance(residuals, visible)));
  NormalEquations sum;
  const std::span<const TemplatePoint> points = level.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (residuals[i].distance < 0.0f) continue;
    const double e = static_cast<double>(residuals[i].distance) / scale;
    const double w = 1.0 / (1.0 + e * e);
    add_point(points[i], residuals[i], w * w, focal_px, sum);
  }
  return sum;
}

// Aligns one level, starting from and improving `alignment`.
void align_level(const KernelTable& kernels, const TemplateLevel& level, const PyramidLevel& frame,
                 const AlignmentScratch& scratch, Alignment& alignment) {
  const std::span<const TemplatePoint> points = level.points();
  const std::span<PointResidual> residuals = scratch.residuals.first(points.size());
  alignment.has_converged = false;
  for (int i = 0; i < kMaxIterations; ++i) {
    const int visible = kernels.sample_residuals(points, make_warp(alignment.T_current_key, frame),
                                                 frame.planes, residuals);
    if (visible < kMinPoints) break;
    const NormalEquations sum = accumulate(level, residuals, visible, frame.focal_px);
    alignment.information = sum.H;
    const Vector6 xi = sum.H.ldlt().solve(sum.g);
    if (!xi.allFinite()) break;
    // r(ξ) ≈ r - ∇φ J ξ is least at ξ; the template moves by ξ, so the frame moves back.
    alignment.T_current_key = alignment.T_current_key * Se3::exp(-xi);
    ++alignment.iterations;
    const double step_px =
        xi.head<3>().norm() * static_cast<double>(level.mean_inverse_depth_focal) +
        xi.tail<3>().norm() * frame.focal_px;
    if (step_px < kConvergedStepPx) {
      alignment.has_converged = true;
      break;
    }
  }
  (void)kernels.sample_residuals(points, make_warp(alignment.T_current_key, frame), frame.planes,
                                 residuals);
  alignment.score = score_residuals(residuals);
}

}  // namespace

AlignmentScratch allocate_alignment_scratch(int points_per_level, Arena& arena) {
  return {arena.allocate<PointResidual>(points_per_level, "point residuals")};
}

Alignment align_frame(const KernelTable& kernels, const KeyframeTemplate& keyframe,
                      const FramePyramid& frame, std::span<const Se3> guesses,
                      const AlignmentScratch& scratch) {
  CHECK(!guesses.empty(), "an alignment starts somewhere");
  CHECK(keyframe.levels.size() == frame.size(), "template and frame have the same levels");
  const int coarsest = static_cast<int>(frame.size()) - 1;
  Alignment best;
  int iterations = 0;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    Alignment trial;
    trial.T_current_key = guesses[i];
    align_level(kernels, keyframe.levels[coarsest], frame[coarsest], scratch, trial);
    iterations += trial.iterations;
    if (i == 0 || trial.score.rank() < best.score.rank()) best = trial;
  }
  best.iterations = iterations;
  for (int l = coarsest - 1; l >= 0; --l) {
    align_level(kernels, keyframe.levels[l], frame[l], scratch, best);
  }
  return best;
}

}  // namespace darkling
