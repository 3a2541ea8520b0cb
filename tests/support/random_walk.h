// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/se3.h"
#include "io/trajectory.h"
#include "support/random.h"

namespace darkling::test {

// A pair of trajectories for tests of evaluation: a truth that winds through space, and an estimate
// of it whose every step is off.
struct RandomWalk {
  std::vector<Se3> truth;
  std::vector<Se3> estimate;  // in a world of its own
};

// @param step_m  length of a step, about.
// @param error  of a step: metres in each direction, and half as many radians about each axis.
[[nodiscard]] inline RandomWalk random_walk(std::uint64_t seed, int count, double step_m,
                                            double error) {
  Random random(seed);
  RandomWalk walk{.truth = {Se3()}, .estimate = {Se3(so3_exp({0.3, -0.2, 0.1}), {4, 5, 6})}};
  for (int i = 1; i < count; ++i) {
    Vector6 step;
    step << random.vector<3>(0.1 * step_m), random.vector<3>(0.05);
    step.z() += step_m;
    Vector6 off;
    off << random.vector<3>(error), random.vector<3>(0.5 * error);
    walk.truth.push_back(plus(walk.truth.back(), step));
    walk.estimate.push_back(plus(walk.estimate.back(), step) * Se3::exp(off));
  }
  return walk;
}

[[nodiscard]] inline Trajectory rows_of(const std::vector<Se3>& poses) {
  Trajectory trajectory{.frame = PoseFrame::kLeft, .key = PoseKey::kRow, .poses = {}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    trajectory.poses.push_back(
        {frame_time_from_ns(static_cast<std::int64_t>(i)), to_affine(poses[i])});
  }
  return trajectory;
}

}  // namespace darkling::test
