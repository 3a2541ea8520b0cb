// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "geometry/se3.h"
#include "kernels/kernel_table.h"
#include "vo/frame_pyramid.h"
#include "vo/keyframe_template.h"

namespace darkling {

// Descriptor distance, root mean square over the planes in 0…255, at which a point counts as not
// matching at all. Two unrelated neighbourhoods are about 110 apart.
inline constexpr double kDistanceTruncation = 80.0;

// How well a template lies on a frame: on a fixed scale, so that it can be compared between poses,
// frames and scenes. A scale taken from the residuals would make a wrong pose look good.
struct AlignmentScore {
  // Mean of min(d, truncation) / truncation, d the points' distances to the frame: 0…1. In noise,
  // when much of the planes is undecided, everything is near to everything.
  double distance = 1.0;
  // The same over what it would be if frame and template had nothing to do with each other, however
  // much of either is undecided: 0 is equal, 1 is unrelated. Without the division, noise aligned to
  // noise costs 0.15 to 0.25, less than most right poses.
  double cost = 1.0;
  double visible_fraction = 0.0;  // of the template's points, 0…1
  int visible_count = 0;
  // What two poses are compared by: points that left the image count half.
  [[nodiscard]] double rank() const {
    return visible_fraction * distance + 0.5 * (1.0 - visible_fraction);
  }
};

struct Alignment {
  Se3 T_current_key;
  AlignmentScore score;        // at the finest level that was aligned
  int iterations = 0;          // all levels together
  bool has_converged = false;  // the last step at the finest level was small enough
  // Normal equations H of the finest level at the solution, weighted, for a right perturbation of
  // T_current_key; and the scale of the weights, as normal_equations() takes it. What follows for
  // the covariance is in vo/covariance.h.
  Matrix6 information = Matrix6::Zero();
  float inverse_scale = 0.0f;
};

// Of what sample_residuals() left of a comparison with `planes` at, or nearly at, `warp`.
[[nodiscard]] AlignmentScore score_residuals(const TemplatePoints& points,
                                             const PointResiduals& residuals, const PointWarp& warp,
                                             const ImageView<const std::uint8_t>& planes);

// Scratch of one alignment.
[[nodiscard]] PointResiduals allocate_residuals(int points_per_level, Arena& arena);

// Where T_current_key puts template points in an image of this level.
[[nodiscard]] PointWarp make_warp(const Se3& T_current_key, const PyramidLevel& level);

// 8 σ² of the robust weights: σ is 0.8 of the median distance, and a grey level at least.
[[nodiscard]] float weight_scale_squares(const PointResiduals& residuals, int count, int visible);

struct NormalEquations {
  Matrix6 H;
  Vector6 g;
};
// A kernel's sums in m and rad.
[[nodiscard]] NormalEquations unpack(const NormalSums& sums, double focal_px);

// How a level is aligned: until a step is smaller than this, or for so many, and by which points.
struct AlignTask {
  double step_px = 0.0;
  int iterations = 0;
  std::span<const std::uint8_t> left_out = {};  // of each point: not 0 if it has no say; empty: all
};

// How far a small motion moves, in px, what is at the mean depth.
[[nodiscard]] double motion_px(const Vector6& xi, double mean_inverse_depth_focal, double focal_px);

// As align_frame() aligns a level.
[[nodiscard]] AlignTask task_of_level(int level, std::span<const std::uint8_t> left_out = {});

// Takes points out of what was sampled, as if they were not seen.
// @return how many are still seen of those that were, `visible`.
int leave_out(std::span<const std::uint8_t> left_out, int visible, const PointResiduals& residuals);

// Aligns one level, starting from and improving `alignment`. Leaves the residuals before the last
// step, which is too small to matter if the level converged.
void align_level(const KernelTable& kernels, const TemplateLevel& level, const PyramidLevel& frame,
                 const AlignTask& task, const PointResiduals& residuals, Alignment& alignment);

// From the best of several guesses on the coarsest level down to the finest.
// @param guesses  of T_current_key, at least one.
// @param align  (level, alignment): improves it on that level.
// @param score  (level, alignment): what it is worth there, right after it was aligned.
// @return an alignment with its score on the finest level and all iterations.
template <typename Align, typename Score>
[[nodiscard]] Alignment align_from_coarse(int level_count, std::span<const Se3> guesses,
                                          const Align& align, const Score& score) {
  const int coarsest = level_count - 1;
  Alignment best;
  int iterations = 0;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    Alignment trial;
    trial.T_current_key = guesses[i];
    align(coarsest, trial);
    trial.score = score(coarsest, trial);
    iterations += trial.iterations;
    if (i == 0 || trial.score.rank() < best.score.rank()) best = trial;
  }
  best.iterations = iterations;
  for (int l = coarsest - 1; l >= 0; --l) align(l, best);
  if (coarsest > 0) best.score = score(0, best);
  return best;
}

// Aligns a keyframe's template to the current frame from coarse to fine: Gauss-Newton with the
// inverse compositional update in disparity space, one robust weight a point.
//
// @param guesses  of T_current_key. All are aligned at the coarsest level; the best goes on.
// @param levels  it starts from the coarsest of so many, the finest ones.
// @pre at least one guess; template and frame have the same levels.
// @return an alignment in every case; the score says what it is worth.
// Source: Alismail, Browning, "Direct disparity space: robust and real-time visual odometry",
// 2014; Baker, Matthews, "Lucas-Kanade 20 years on", 2004, for the inverse composition.
[[nodiscard]] Alignment align_frame(const KernelTable& kernels, const KeyframeTemplate& keyframe,
                                    const FramePyramid& frame, std::span<const Se3> guesses,
                                    const PointResiduals& scratch, int levels = kMaxLevels);

}  // namespace darkling
