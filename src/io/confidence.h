// SPDX-License-Identifier: Apache-2.0
// Whether motions that claim to be right are.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/se3.h"
#include "vo/estimate.h"

namespace darkling {

// Whether whoever steers by the motion has no reason to doubt it.
[[nodiscard]] bool is_confident(const Estimate& estimate);

// Of the confident motions that have a truth.
struct Confidence {
  int frames = 0;
  std::vector<std::size_t> wrong;  // of these, confidently wrong: see ConfidenceCount::add()
};

class ConfidenceCount {
 public:
  // The confident motion of frame `index`. It is wrong when its translation or its rotation is, and
  // that when the part's error is outside the ellipsoid of its own covariance that holds 99.73 %,
  // as 3 σ do, and is large besides: a translation off by more than 5 % of the true one and by more
  // than 1 mm, which is noise when standing still; a rotation by more than 0.5 deg. Parts are taken
  // by themselves, as a rotation of small σ would hide what the translation claims, and one of a
  // large σ what it does not. A covariance that is not known or not one claims nothing: never
  // wrong.
  // @param xi, covariance  error and covariance of the motion: (translation, rotation), right
  //        perturbation.
  // @param true_step_m  length of the true translation.
  void add(std::size_t index, const Vector6& xi, const Matrix6& covariance, double true_step_m);

  [[nodiscard]] const Confidence& counts() const { return counts_; }

 private:
  Confidence counts_;
};

}  // namespace darkling
