// SPDX-License-Identifier: Apache-2.0
// How far an alignment may be off, and what follows for motions and poses.
//
// Alignment. At the solution the points' weighted residuals c_i = w_i b_i balance, Σ Jᵢᵀ c_i = 0.
// If what is wrong with the points of one tile of the image has nothing to do with other tiles,
// then for a right perturbation of T_current_key, with J and H as in kernels/normal_equations.h,
//   Σ_align = B⁻¹ M B⁻¹,   M = n / (n - 6) Σ_tiles (Σ Jᵢᵀ c_i) (Σ Jᵢᵀ c_i)ᵀ, (1) B = Σ Jᵢᵀ (w_i
//   (S_i - λ squares_i I) - 4a u_i³ b_i b_iᵀ) Jᵢ,   w = u² = 1 / (1 + a squares)²,  (2)
// n tiles with points. It needs no scale of the residuals and no model of the noise: wrong depths,
// uneven noise and points on other surfaces all show in their own c. In (2), the derivative of
// Σ Jᵀ c, the last term is what weights that fall with the residual do: with H in its place,
// promised variances were 2 to 3 times too small. S holds the noise of the template's gradients
// too, which tells nothing about motion; λ squares is about as much of it. With every point for
// itself in place of tiles, variances of rotations were 2 times too small where much is far away.
//
// Motion between two frames on one keyframe. Errors of depth and of the reference are in both
// alignments and cancel: c_i is replaced by its change since the frame before, (3) where it was 0
// if that was the keyframe itself.
//
// Scale. Stereo sees all depths too far or too near by one factor, the longer way is the wrong
// way, and no residual shows it. With standard deviation σ of the logarithm of scale, a
// displacement p adds σ² p pᵀ to the translation; on a path the errors add up before they are
// squared: (Σ σ p) (Σ σ p)ᵀ.                                                                    (4)
//
// Transport. All are right perturbations, T = T_true exp(ξ). With T_key_current = T_current_key⁻¹,
// a perturbation of T_current_key by ε is one of T_key_current by -Ad(T_current_key) ε, and one of
// T_world_key by ξ is one of T_world_current by Ad(T_current_key) ξ:
//   Σ_world_current = Ad (Σ_world_key + κ Σ_align) Adᵀ,   Ad = Ad(T_current_key), (5)
// κ > 1 for errors that keyframes share with the next.
//
// Source: (1) Huber, "The behavior of maximum likelihood estimates under nonstandard conditions",
// 1967; White, "A heteroskedasticity-consistent covariance matrix estimator and a direct test for
// heteroskedasticity", 1980; Liang, Zeger, "Longitudinal data analysis using generalized linear
// models", 1986, for sums over tiles. (5) Solà, Deray, Atchuthan, "A micro Lie theory for state
// estimation in robotics", 2018.
#pragma once

#include <span>

#include "base/arena.h"
#include "kernels/kernel_table.h"
#include "vo/align.h"

namespace darkling {

// The diagonal of what is not known, m² and rad².
inline constexpr double kUnknownVariance = 9999.0;
[[nodiscard]] inline Matrix6 unknown_covariance() {
  return Matrix6::Identity() * kUnknownVariance;
}
[[nodiscard]] bool is_known(const Matrix6& covariance);

// Memory of (1) to (3); arrays of round_up_to_lanes(points).
struct PointInfluences {
  // Σ Jᵀ c / f of a tile.
  struct Tile {
    float alignment[6];
    float change[6];  // since the frame before
  };
  float* cx = nullptr;  // 0 where a point was not seen
  float* cy = nullptr;
  float* cx_before = nullptr;
  float* cy_before = nullptr;
  float* xx = nullptr;  // what (2) takes from w S
  float* xy = nullptr;
  float* yy = nullptr;
  std::span<Tile> tiles;
};
[[nodiscard]] PointInfluences allocate_influences(int points_per_level, Arena& arena);

// An alignment just made, with what it was made from.
struct AlignedFrame {
  const RectifiedRig& rig;
  const TemplateLevel& finest;
  const Alignment& alignment;
  const PointResiduals& residuals;  // as align_frame() left them
};

// Right perturbations of T_current_key, without (4); not known where the alignment is no minimum.
struct AlignmentCovariances {
  Matrix6 of_alignment = Matrix6::Zero();  // (1)
  Matrix6 of_change = Matrix6::Zero();     // (3)
};

// @param influences  c of the frame before, on the same keyframe; left as those of this one.
// @param is_first  on this keyframe: before it was the keyframe itself.
// Exactness: the same bits with every kernel table.
// Cost: one normal_equations() of the finest level, some 60 operations a point beside it.
[[nodiscard]] AlignmentCovariances estimate_covariances(const KernelTable& kernels,
                                                        const AlignedFrame& frame, bool is_first,
                                                        PointInfluences& influences);

// Covariances of the motions and poses of the left camera, from relative quantities only: poses of
// keyframes may be corrected without its knowing.
class PoseCovariance {
 public:
  // What is not known of one frame's pose.
  struct Accumulated {
    Matrix6 covariance = Matrix6::Zero();  // without (4)
    Vector3 scale_m = Vector3::Zero();     // Σ σ p
  };

  // Starts over: the present frame is a keyframe, and its pose what others are relative to.
  void reset();
  // The frame that moved last becomes the keyframe.
  void set_keyframe();
  // A frame was aligned to the keyframe.
  void move(const KernelTable& kernels, const AlignedFrame& frame, PointInfluences& influences);

  // The pose of the frame that moved last is known anew, from an alignment to another keyframe,
  // whose keyframe() was `key` then. Its motion stays as it was measured.
  void rebase(const Accumulated& key, const KernelTable& kernels, const AlignedFrame& frame,
              PointInfluences& influences);
  // Of the present keyframe's pose.
  [[nodiscard]] const Accumulated& keyframe() const { return key_; }

  // Right perturbation of T_previous_left, previous being the frame before on which move() or
  // reset() was called.
  [[nodiscard]] const Matrix6& motion() const { return cov_motion_; }
  // Right perturbation of T_start_left, start being the last reset().
  [[nodiscard]] const Matrix6& pose() const { return cov_pose_; }

 private:
  Accumulated key_;      // of T_start_key
  Accumulated current_;  // of T_start_current
  Se3 T_current_key_;
  bool is_on_keyframe_ = true;  // the frame moved last is the keyframe
  Matrix6 cov_motion_ = Matrix6::Zero();
  Matrix6 cov_pose_ = Matrix6::Zero();
};

// The covariance of a right perturbation of T_x_a as that of T_x_b; what is not known stays so.
[[nodiscard]] Matrix6 transport_covariance(const Matrix6& covariance, const Se3& T_b_a);

}  // namespace darkling
