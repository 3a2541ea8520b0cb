// SPDX-License-Identifier: Apache-2.0
// Whether covariances keep what they promise.
#pragma once

#include <cstddef>
#include <optional>

#include "geometry/se3.h"

namespace darkling {

// Normalised estimation error squared: of an error ξ and its covariance Σ, ξᵀ Σ⁻¹ ξ over the number
// of dimensions. It is 1 on average where covariances are right, and above where they promise too
// much. Source: Bar-Shalom, Li, Kirubarajan, "Estimation with applications to tracking and
// navigation", 2001.
struct Nees {
  int count = 0;              // errors it is the mean of
  double mean = 0.0;          // over 6
  double translation = 0.0;   // over 3, whatever the rotation
  double rotation = 0.0;      // over 3, whatever the translation
  double share_beyond = 0.0;  // of errors outside the ellipsoid that holds 99.73 %, as 3 σ do
};

class NeesMean {
 public:
  // A covariance that is not known, or zero where a path starts, says nothing and is left out.
  // @param xi, covariance  (translation, rotation), right perturbation.
  void add(const Vector6& xi, const Matrix6& covariance);
  // @return nothing for no errors.
  [[nodiscard]] std::optional<Nees> mean() const;

 private:
  Nees sums_;
};

// What is known of the truth itself: standard deviation of each component of the motion between two
// true poses. On recordings most of it grows with the motion, as what differs is how the truth's
// sensor is mounted and how long its metre is: errors that several widths have in common are 1.5 to
// 2 % of EuRoC's translations and 1 % of its rotations, over one frame and over ten. Of KITTI's
// they are 0.6 % of the translations and 0.04 deg of rotation a frame, though it hardly turns.
struct TruthNoise {
  double share = 0.0;      // of the length of the translation, and of the angle of the rotation
  double angle_deg = 0.0;  // besides, of the rotation from a frame to the next; adds up as a walk
};

// The covariance of the truth's part in the error of a motion that spans `frames`.
[[nodiscard]] Matrix6 truth_covariance(const TruthNoise& noise, const Se3& T_a_b,
                                       std::size_t frames);

}  // namespace darkling
