// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <Eigen/Cholesky>

#include "support/dense_window_system.h"
#include "support/window_stages.h"

namespace darkling {
namespace {

using test::DenseSystem;

// Greatest difference, relative to the geometric mean of the diagonal elements that belong to an
// entry: the measure in which a metre, a radian and a px/m weigh the same.
double difference(const DenseSystem& a, const DenseSystem& b) {
  const Eigen::VectorXd scale = b.H.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (a.H - b.H) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}
double gradient_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                           const DenseSystem& unit) {
  return (a - b).cwiseQuotient(unit.H.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff();
}

// Three keyframes, of which every view is taken at the present estimate.
class LineariseWindow : public ::testing::Test {
 protected:
  LineariseWindow() {
    (void)stages_.refine();
    for (int h = 0; h < window().count; ++h) {
      WindowKeyframe& host = window().keyframes()[h];
      for (int j = h + 1; j < window().count; ++j) {
        WindowView& view = host.views[j - h - 1];
        view.T_later_host = window().keyframes()[j].T_world_key.inverse() * host.T_world_key;
        std::copy_n(host.points.inverse_depth_focal, host.points.count, view.depth);
      }
    }
  }
  Window& window() { return stages_.window(); }

  // Half a tenth of a pixel away from the views, in every unknown.
  void move_a_little() {
    test::Random random(3);
    for (WindowKeyframe& keyframe : window().keyframes()) {
      Vector6 xi;
      xi << random.vector<3>(0.002), random.vector<3>(0.0004);
      keyframe.T_world_key = plus(keyframe.T_world_key, xi);
      for (int i = 0; i < keyframe.points.count; ++i) {
        keyframe.points.inverse_depth_focal[i] += float(random.uniform(-0.2, 0.2));
      }
    }
  }
  DenseSystem linearise() {
    stages_.linearise();
    return test::product_system(window(), stages_.equations());
  }
  double cost() {
    stages_.linearise();
    return stages_.equations().cost;
  }

  test::PlaneWorld world_;
  test::PlaneWindow stages_{world_, {.keyframes = 3, .points = 60}};
};

TEST_F(LineariseWindow, CostsWhatTheModelCosts) {
  EXPECT_NEAR(cost(), test::cost_of(window(), test::state_of(window())), 1e-4 * cost());
  move_a_little();
  EXPECT_NEAR(cost(), test::cost_of(window(), test::state_of(window())), 1e-4 * cost());
}

TEST_F(LineariseWindow, GivesEveryBlockOfTheModelsSystemAtThePlaceOfComparison) {
  const DenseSystem product = linearise();
  const DenseSystem model = test::model_system(window());
  EXPECT_LT(difference(product, model), 1e-4);
  EXPECT_LT(gradient_difference(product.g, model.g, model), 1e-3);
}

// Derivatives leave out how J and J_s themselves change.
TEST_F(LineariseWindow, GivesEveryBlockNearlyBesideThePlaceOfComparison) {
  move_a_little();
  const DenseSystem product = linearise();
  const DenseSystem model = test::model_system(window());
  EXPECT_LT(difference(product, model), 0.05);
  EXPECT_LT(gradient_difference(product.g, model.g, model), 0.2);
}

TEST_F(LineariseWindow, TellsAWrongBlockFromARightOne) {
  const DenseSystem model = test::model_system(window());
  for (const auto& [row, column] : {std::pair(7, 2), std::pair(13, 40), std::pair(50, 50)}) {
    DenseSystem wrong = model;
    wrong.H(row, column) -= 0.1 * std::sqrt(wrong.H(row, row) * wrong.H(column, column));
    EXPECT_GT(difference(wrong, model), 0.09);
  }
}

TEST_F(LineariseWindow, GradientIsHalfThatOfTheCostInEveryPose) {
  const DenseSystem product = linearise();
  for (int k = 0; k < window().count; ++k) {
    Se3& T_world_key = window().keyframes()[k].T_world_key;
    const Se3 here = T_world_key;
    const auto cost_at = [&](const Vector6& xi) {
      T_world_key = plus(here, xi);
      return Eigen::Matrix<double, 1, 1>(cost());
    };
    const Vector6 slope = test::numeric_jacobian<1, 6>(cost_at, Vector6(Vector6::Zero()), 1e-4);
    T_world_key = here;
    for (int i = 0; i < 6; ++i) {
      const double unit = std::sqrt(product.H(6 * k + i, 6 * k + i));
      EXPECT_NEAR(product.g[6 * k + i] / unit, 0.5 * slope[i] / unit, 2e-3) << k << " " << i;
    }
  }
}

TEST_F(LineariseWindow, GradientIsHalfThatOfTheCostInEveryDepth) {
  const DenseSystem product = linearise();
  int n = product.pose_count;
  for (WindowKeyframe& keyframe : window().keyframes()) {
    for (int i = 0; i < keyframe.points.count; ++i, ++n) {
      float& s = keyframe.points.inverse_depth_focal[i];
      const float here = s;
      const auto cost_at = [&](const Eigen::Matrix<double, 1, 1>& ds) {
        s = here + float(ds[0]);
        return Eigen::Matrix<double, 1, 1>(cost());
      };
      const double slope = test::numeric_jacobian<1, 1>(
          cost_at, Eigen::Matrix<double, 1, 1>(Eigen::Matrix<double, 1, 1>::Zero()), 0.02)(0);
      s = here;
      const double unit = std::sqrt(product.H(n, n));
      ASSERT_NEAR(product.g[n] / unit, 0.5 * slope / unit, 2e-3) << i;
    }
  }
}

TEST_F(LineariseWindow, EliminatesDepthsToWhatADenseSolveOfAllUnknownsGives) {
  const DenseSystem product = linearise();
  const WindowEquations& equations = stages_.equations();
  const int size = static_cast<int>(product.g.size());
  const DenseSystem model = test::model_system(window());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);  // the oldest pose stays
  all.tail(size - 6) =
      -model.H.bottomRightCorner(size - 6, size - 6).ldlt().solve(model.g.tail(size - 6));

  const int n = 6 * (window().count - 1);
  Eigen::MatrixXd H(n, n);
  Eigen::VectorXd g(n);
  for (int i = 0; i < n; ++i) {
    g[i] = equations.g[6 + i];
    for (int j = 0; j < n; ++j) H(i, j) = equations.H[(6 + i) * kMaxWindowUnknowns + 6 + j];
  }
  const Eigen::VectorXd step = -H.ldlt().solve(g);
  EXPECT_LT((step - all.segment(6, n)).norm(), 0.005 * all.segment(6, n).norm());

  std::vector<Vector6> steps(window().count, Vector6::Zero());
  for (int k = 1; k < window().count; ++k) steps[k] = step.segment<6>(6 * (k - 1));
  int first = product.pose_count;
  for (int h = 0; h < window().count; ++h) {
    std::vector<float> change(window().keyframes()[h].points.count);
    substitute_depths(window(), equations, h, steps, change);
    for (const float ds : change) ASSERT_NEAR(ds, all[first++], 0.005);
  }
}

}  // namespace
}  // namespace darkling
