// SPDX-License-Identifier: Apache-2.0
// The window's minimum against that which Ceres finds for the same problem.
#include <algorithm>
#include <cmath>
#include <vector>

#include <ceres/ceres.h>
#undef CHECK  // glog's; ours comes with the headers below

#include "support/window_model.h"
#include "support/window_stages.h"
#include "synthetic_window.h"

namespace darkling {
namespace {

// Ceres minimises Σ ρ(e) / 2.
class GemanMcClure : public ceres::LossFunction {
 public:
  void Evaluate(double e, double rho[3]) const override {
    const double inverse = 1.0 / (1.0 + e);
    rho[0] = 2.0 * e * inverse;
    rho[1] = 2.0 * inverse * inverse;
    rho[2] = -4.0 * inverse * inverse * inverse;
  }
};

// The residual of one comparison, its poses as right perturbations of those at the start.
struct ComparisonResidual {
  const Window& window;
  const test::WindowState& start;
  test::Comparison at;

  bool operator()(const double* host, const double* later, const double* depth, double* out) const {
    const auto pose = [&](int keyframe, const double* xi) {
      return plus(start.T_world_key[keyframe], Vector6(Eigen::Map<const Vector6>(xi)));
    };
    const Vector3 r =
        residual(window, at, pose(at.host, host), pose(std::max(at.later, 0), later), *depth);
    std::copy_n(r.data(), 3, out);
    return true;
  }
};

struct Minimum {
  test::WindowState state;
  double cost = 0.0;
  bool has_converged = false;
};

Minimum minimise_with_ceres(const Window& window) {
  const test::WindowState start = test::state_of(window);
  Minimum minimum = {start};
  std::vector<Vector6> steps(start.T_world_key.size(), Vector6::Zero());
  Vector6 unused = Vector6::Zero();  // what stereo is not a function of
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  GemanMcClure loss;
  ceres::Problem problem(ownership);
  for (const test::Comparison& at : test::comparisons_of(window)) {
    using Cost = ceres::NumericDiffCostFunction<ComparisonResidual, ceres::CENTRAL, 3, 6, 6, 1>;
    double* depth = &minimum.state.depths[at.depth];
    double* later = at.later < 0 ? unused.data() : steps[at.later].data();
    problem.AddResidualBlock(new Cost(new ComparisonResidual{window, start, at}), &loss,
                             steps[at.host].data(), later, depth);
    problem.SetParameterLowerBound(depth, 0, 0.0);
  }
  problem.SetParameterBlockConstant(steps[0].data());
  problem.SetParameterBlockConstant(unused.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  minimum.cost = summary.final_cost;
  minimum.has_converged = summary.termination_type == ceres::CONVERGENCE;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    minimum.state.T_world_key[k] = plus(start.T_world_key[k], steps[k]);
  }
  return minimum;
}

// What the window's estimate differs by from a minimum.
struct Difference {
  double cost = 0.0;          // share of it
  double pose_px = 0.0;       // the greatest of all keyframes
  double close_depths = 0.0;  // share of disparities within 0.05 px
};

Difference difference(const Window& window, double cost, const Minimum& minimum) {
  Difference found;
  found.cost = std::abs(cost - minimum.cost) / minimum.cost;
  std::size_t depth = 0;
  int close = 0;
  for (int k = 0; k < window.count; ++k) {
    const WindowKeyframe& keyframe = window.keyframes()[k];
    found.pose_px =
        std::max(found.pose_px, test::image_motion_px(window, keyframe, keyframe.T_world_key,
                                                      minimum.state.T_world_key[k]));
    for (int i = 0; i < keyframe.points.count; ++i, ++depth) {
      const double difference_px =
          window.baseline_m *
          (double(keyframe.points.inverse_depth_focal[i]) - minimum.state.depths[depth]);
      close += std::abs(difference_px) < 0.05 ? 1 : 0;
    }
  }
  found.close_depths = double(close) / double(depth);
  return found;
}

// A window of a drive with its last image seen; all poses but the oldest are then moved by 0.2 px,
// and every other disparity by 0.1 px.
class WindowMinimum : public ::testing::TestWithParam<const char*> {
 protected:
  WindowMinimum()
      : run_(test::synthetic_run(GetParam())),
        stages_(run_, rectify_rig(run_.rig, 160).value(), 2) {
    (void)stages_.refine();
    test::Random random(9);
    for (int k = 0; k < window().count; ++k) {
      WindowKeyframe& keyframe = window().keyframes()[k];
      for (int i = 0; i < keyframe.points.count; i += 2) {
        keyframe.points.inverse_depth_focal[i] += float(0.1 / window().baseline_m);
      }
      if (k == 0) continue;
      Vector6 xi;
      xi << random.vector<3>(0.004), random.vector<3>(0.0005);
      keyframe.T_world_key = plus(keyframe.T_world_key, xi);
    }
  }
  Window& window() { return stages_.window(); }

  const test::SyntheticRun& run_;
  test::SyntheticWindow stages_;
};

TEST_P(WindowMinimum, IsWhatTheModelCosts) {
  EXPECT_EQ(window().count, 5);
  EXPECT_GT(test::comparisons_of(window()).size(), 2000u);
  EXPECT_NEAR(stages_.cost(), test::cost_of(window(), test::state_of(window())),
              1e-4 * stages_.cost());
}

TEST_P(WindowMinimum, IsThatOfCeres) {
  const double start = stages_.cost();
  const Minimum minimum = minimise_with_ceres(window());
  ASSERT_TRUE(minimum.has_converged);
  const Difference before = difference(window(), start, minimum);
  EXPECT_GT(before.cost, 0.01);  // or there was nothing to find
  EXPECT_GT(before.pose_px, 0.1);
  EXPECT_LT(before.close_depths, 0.6);

  EXPECT_EQ(stages_.descend(), Refinement::kApplied);
  const Difference once = difference(window(), stages_.cost(), minimum);
  EXPECT_LT(once.cost, 1e-3);
  EXPECT_LT(once.pose_px, 0.04);
  EXPECT_GT(once.close_depths, 0.95);

  for (int round = 0; round < 10 && stages_.descend() == Refinement::kApplied; ++round) {
  }
  const Difference after = difference(window(), stages_.cost(), minimum);
  EXPECT_LT(after.cost, 2e-4);
  EXPECT_LT(after.pose_px, 0.02);
  EXPECT_GT(after.close_depths, 0.97);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WindowMinimum,
                         ::testing::Values("corridor,frames=9,width=320",
                                           "quarry,frames=9,width=320"));

}  // namespace
}  // namespace darkling
