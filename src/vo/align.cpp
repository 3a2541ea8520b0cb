// SPDX-License-Identifier: Apache-2.0
#include "vo/align.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>

namespace darkling {

namespace {

// Descriptor distance, root mean square over the planes in 0…255, at which a point counts as not
// matching at all. Two unrelated neighbourhoods are about 110 apart.
constexpr double kCostTruncation = 80.0;
constexpr int kMaxIterations = 30;  // a level
// A step this small ends a level, in its own pixels. The next level goes on from there, so that
// coarse ones need less: with 0.01 px for all it took twice the iterations and no recording's drift
// or RPE differed by 1 %.
constexpr double kConvergedStepPx = 0.01;
constexpr double kConvergedCoarseStepPx = 0.1;
constexpr int kMinPoints = 12;  // twice the unknowns; fewer do not constrain a motion

AlignmentScore score_residuals(const PointResiduals& residuals, int count) {
  double sum = 0.0;
  int visible = 0;
  for (int i = 0; i < count; ++i) {
    const float squares = residuals.squares[i];
    if (squares < 0.0f) continue;
    sum += std::min(std::sqrt(static_cast<double>(squares) / kPlaneCount), kCostTruncation);
    ++visible;
  }
  AlignmentScore score;
  score.visible_count = visible;
  if (visible == 0) return score;
  score.cost = sum / (kCostTruncation * visible);
  score.visible_fraction = static_cast<double>(visible) / count;
  return score;
}

// The median of the visible points' sums of squares, from a histogram whose bins are floating-point
// numbers cut after three bits of mantissa: 4 to 6 % of the distance each.
float median_squares(const PointResiduals& residuals, int count, int visible) {
  constexpr int kShift = 20;
  constexpr int kBins = 256;  // from 2^-12 to 2^20 of squares, eight an octave
  constexpr std::uint32_t kFirst = (127u - 12u) << 3;
  std::array<int, kBins> histogram = {};
  const auto bin_of = [](float squares) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(squares) >> kShift;
    return std::clamp(static_cast<int>(bits - kFirst), 0, kBins - 1);
  };
  for (int i = 0; i < count; ++i) {
    if (residuals.squares[i] >= 0.0f) ++histogram[bin_of(residuals.squares[i])];
  }
  int below = 0;
  int bin = 0;
  while (2 * (below + histogram[bin]) < visible) below += histogram[bin++];
  const auto edge = [](int i) {
    return std::bit_cast<float>((static_cast<std::uint32_t>(i) + kFirst) << kShift);
  };
  const float share = (0.5f * static_cast<float>(visible) - static_cast<float>(below)) /
                      static_cast<float>(std::max(histogram[bin], 1));
  return edge(bin) + share * (edge(bin + 1) - edge(bin));
}

// One robust weight a point, on the scale of the median, so that points that do not match have no
// say. Geman and McClure's against Cauchy's of the same efficiency: the drift of a car fell by a
// tenth (steps of 3.6 m: by a fifth); RPE of a drone rose by 2 to 5 %.
NormalEquations accumulate(const KernelTable& kernels, const TemplatePoints& points,
                           const PointResiduals& residuals, double focal_px, float inverse_scale) {
  NormalSums sums;
  kernels.normal_equations(points, residuals, static_cast<float>(focal_px), inverse_scale, sums);
  return unpack(sums, focal_px);
}

// Aligns one level, starting from and improving `alignment`. Leaves the residuals before the last
// step, which is too small to matter if the level converged.
void align_level(const KernelTable& kernels, const TemplateLevel& level, const PyramidLevel& frame,
                 double converged_step_px, const PointResiduals& residuals, Alignment& alignment) {
  const TemplatePoints& points = level.points;
  alignment.has_converged = false;
  for (int i = 0; i < kMaxIterations; ++i) {
    const int visible = kernels.sample_residuals(points, make_warp(alignment.T_current_key, frame),
                                                 frame.planes, residuals);
    if (visible < kMinPoints) break;
    alignment.inverse_scale = 1.0f / weight_scale_squares(residuals, points.count, visible);
    const NormalEquations sum =
        accumulate(kernels, points, residuals, frame.focal_px, alignment.inverse_scale);
    alignment.information = sum.H;
    const Vector6 xi = sum.H.ldlt().solve(sum.g);
    if (!xi.allFinite()) break;
    // r(ξ) ≈ r - ∇φ J ξ is least at ξ; the template moves by ξ, so the frame moves back.
    alignment.T_current_key = alignment.T_current_key * Se3::exp(-xi);
    ++alignment.iterations;
    const double step_px =
        xi.head<3>().norm() * static_cast<double>(level.mean_inverse_depth_focal) +
        xi.tail<3>().norm() * frame.focal_px;
    if (step_px < converged_step_px) {
      alignment.has_converged = true;
      break;
    }
  }
}

}  // namespace

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

NormalEquations unpack(const NormalSums& sums, double focal_px) {
  const double f2 = focal_px * focal_px;
  NormalEquations equations;
  int entry = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j, ++entry) {
      equations.H(i, j) = f2 * static_cast<double>(sums.H[entry]);
      equations.H(j, i) = equations.H(i, j);
    }
    equations.g[i] = focal_px * static_cast<double>(sums.g[i]);
  }
  return equations;
}

float weight_scale_squares(const PointResiduals& residuals, int count, int visible) {
  constexpr float kScaleOfMedian = 0.8f;
  constexpr float kLeastSquares = kPlaneCount;  // σ of one grey level
  return std::max(kLeastSquares,
                  kScaleOfMedian * kScaleOfMedian * median_squares(residuals, count, visible));
}

PointResiduals allocate_residuals(int points_per_level, Arena& arena) {
  const auto array = [&] {
    return arena.allocate<float>(round_up_to_lanes(points_per_level), "point residuals").data();
  };
  return {array(), array(), array()};
}

Alignment align_frame(const KernelTable& kernels, const KeyframeTemplate& keyframe,
                      const FramePyramid& frame, std::span<const Se3> guesses,
                      const PointResiduals& scratch) {
  CHECK(!guesses.empty(), "an alignment starts somewhere");
  CHECK(keyframe.levels.size() == frame.size(), "template and frame have the same levels");
  const int coarsest = static_cast<int>(frame.size()) - 1;
  const auto align = [&](int l, Alignment& alignment) {
    align_level(kernels, keyframe.levels[l], frame[l],
                l == 0 ? kConvergedStepPx : kConvergedCoarseStepPx, scratch, alignment);
  };
  const auto score = [&](int l) {
    return score_residuals(scratch, keyframe.levels[l].points.count);
  };
  Alignment best;
  int iterations = 0;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    Alignment trial;
    trial.T_current_key = guesses[i];
    align(coarsest, trial);
    trial.score = score(coarsest);
    iterations += trial.iterations;
    if (i == 0 || trial.score.rank() < best.score.rank()) best = trial;
  }
  best.iterations = iterations;
  for (int l = coarsest - 1; l >= 0; --l) align(l, best);
  if (coarsest > 0) best.score = score(0);
  return best;
}

}  // namespace darkling
