// SPDX-License-Identifier: Apache-2.0
#include "kernels/normal_equations.h"

#include <cmath>
#include <cstring>
#include <vector>

#include "geometry/se3.h"
#include "support/guarded_points.h"
#include "support/kernel_cases.h"
#include "support/numeric_jacobian.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::GuardedPoints;
using test::GuardedResiduals;
using test::Random;

constexpr float kFocal_px = 123.0f;
constexpr float kInverseScale = 1.0f / 3000.0f;

// Points and what a frame says about them, a third of it not in the image; behind the last point
// stand numbers that must not count.
struct Sample {
  explicit Sample(int count) : guarded(count), residuals(count) {}

  GuardedPoints guarded;
  GuardedResiduals residuals;
};

void fill_randomly(Sample& sample, Random& random) {
  const TemplatePoints& points = sample.guarded.points();
  const PointResiduals out = sample.residuals.out();
  const auto real = [&random](double low, double high) {
    return static_cast<float>(random.uniform(low, high));
  };
  for (int i = 0; i < round_up_to_lanes(points.count); ++i) {
    points.x[i] = real(-160.0, 160.0);
    points.y[i] = real(-120.0, 120.0);
    points.inverse_depth_focal[i] = real(0.0, 60.0);
    // The Gram matrix of two gradients.
    const float gx[2] = {real(-300.0, 300.0), real(-300.0, 300.0)};
    const float gy[2] = {real(-300.0, 300.0), real(-300.0, 300.0)};
    points.Sxx[i] = gx[0] * gx[0] + gx[1] * gx[1];
    points.Sxy[i] = gx[0] * gy[0] + gx[1] * gy[1];
    points.Syy[i] = gy[0] * gy[0] + gy[1] * gy[1];
    const bool is_inside = i < points.count && random.integer(0, 2) > 0;
    out.squares[i] = is_inside ? real(0.0, 20000.0) : -1.0f;
    out.bx[i] = is_inside ? real(-9000.0, 9000.0) : 0.0f;
    out.by[i] = is_inside ? real(-9000.0, 9000.0) : 0.0f;
  }
}

struct ExpectedSums {
  Matrix6 H = Matrix6::Zero();
  Vector6 g = Vector6::Zero();
  Vector6 g_scale = Vector6::Zero();  // Σ of the magnitudes
};

// The derivative of the point's pixel, in units of f, taken numerically from the motion itself. The
// point is kept times s, so that it may be infinitely far away.
Eigen::Matrix<double, 2, 6> jacobian_oracle(const TemplatePoints& points, int i) {
  const double f = kFocal_px;
  const Vector3 ray(points.x[i], points.y[i], f);
  const double s = points.inverse_depth_focal[i];
  return test::numeric_jacobian<2, 6>(
      [&](const Vector6& xi) {
        const Se3 T = Se3::exp(xi);
        const Vector3 q = T.rotation() * ray + s * T.translation();
        return Eigen::Vector2d(q.x() / q.z(), q.y() / q.z());
      },
      Vector6::Zero().eval());
}

ExpectedSums sums_oracle(const TemplatePoints& points, const PointResiduals& residuals) {
  ExpectedSums sums;
  for (int i = 0; i < points.count; ++i) {
    if (residuals.squares[i] < 0.0f) continue;
    const double ratio = double{residuals.squares[i]} * kInverseScale;  // (distance / σ)²
    const double w = std::pow(1.0 + ratio, -2.0);
    const Eigen::Matrix<double, 2, 6> J = jacobian_oracle(points, i);
    Eigen::Matrix2d S;
    S << points.Sxx[i], points.Sxy[i], points.Sxy[i], points.Syy[i];
    const Eigen::Vector2d b(residuals.bx[i], residuals.by[i]);
    sums.H += w * J.transpose() * S * J;
    sums.g += w * J.transpose() * b;
    sums.g_scale += w * J.transpose().cwiseAbs() * b.cwiseAbs();
  }
  return sums;
}

class EachNormalEquations : public ::testing::TestWithParam<KernelTable> {
 protected:
  static NormalSums sum(Sample& sample, float inverse_scale = kInverseScale) {
    NormalSums sums;
    GetParam().normal_equations(sample.guarded.points(), sample.residuals.out(), kFocal_px,
                                inverse_scale, sums);
    EXPECT_TRUE(sample.guarded.padding_is_untouched());
    EXPECT_TRUE(sample.residuals.padding_is_untouched());
    return sums;
  }
};

bool are_same_bits(const NormalSums& a, const NormalSums& b) {
  return std::memcmp(&a, &b, sizeof(NormalSums)) == 0;
}

TEST(SumsOfTwoTables, AreNotTheSameWhenASingleBitDiffers) {
  NormalSums a;
  a.H[20] = a.g[5] = 1.0f;
  NormalSums b = a;
  EXPECT_TRUE(are_same_bits(a, b));
  b.H[20] = std::nextafter(1.0f, 2.0f);
  EXPECT_FALSE(are_same_bits(a, b));
  b = a;
  b.g[0] = -0.0f;
  EXPECT_FALSE(are_same_bits(a, b));
}

TEST_P(EachNormalEquations, EqualTheOracleWithItsNumericJacobianForEveryCount) {
  Random random(1);
  for (const int count : {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12,  13,
                          14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 400, 1000}) {
    SCOPED_TRACE(count);
    Sample sample(count);
    fill_randomly(sample, random);
    const NormalSums sums = sum(sample);
    const ExpectedSums expected = sums_oracle(sample.guarded.points(), sample.residuals.out());
    int entry = 0;
    for (int a = 0; a < 6; ++a) {
      for (int b = a; b < 6; ++b, ++entry) {
        // No term is larger than its share of this (Cauchy and Schwarz); single precision.
        const double scale = std::sqrt(expected.H(a, a) * expected.H(b, b));
        ASSERT_NEAR(sums.H[entry], expected.H(a, b), 1e-5 * scale) << a << " " << b;
      }
      ASSERT_NEAR(sums.g[a], expected.g[a], 1e-5 * expected.g_scale[a]) << a;
    }
  }
}

TEST_P(EachNormalEquations, EqualTheReferenceBitForBitForEveryCount) {
  Random random(2);
  for (int count = 0; count <= 25; ++count) {
    for (int trial = 0; trial < 10; ++trial) {
      Sample sample(count);
      fill_randomly(sample, random);
      NormalSums expected;
      normal_equations_ref(sample.guarded.points(), sample.residuals.out(), kFocal_px,
                           kInverseScale, expected);
      ASSERT_TRUE(are_same_bits(sum(sample), expected)) << count;
    }
  }
}

TEST_P(EachNormalEquations, GiveNoSayToPointsOutsideTheImageOrBehindTheLast) {
  Random random(3);
  for (const int count : {1, 5, 13, 24}) {
    Sample sample(count);
    fill_randomly(sample, random);
    const TemplatePoints& points = sample.guarded.points();
    const PointResiduals out = sample.residuals.out();
    const NormalSums before = sum(sample, 1.0f);  // 1 - 1 · 1: their weight is a division by zero
    int changed = 0;
    for (int i = 0; i < round_up_to_lanes(count); ++i) {
      if (out.squares[i] >= 0.0f) continue;
      points.x[i] *= -3.0f;
      points.inverse_depth_focal[i] += 1000.0f;
      points.Sxx[i] = points.Syy[i] = 1e9f;
      out.bx[i] = 1e9f;
      ++changed;
    }
    ASSERT_GT(changed, 0);
    const NormalSums after = sum(sample, 1.0f);
    for (int i = 0; i < NormalSums::kEntries; ++i) EXPECT_EQ(after.H[i], before.H[i]);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(after.g[i], before.g[i]);
  }
}

// A point on the axis at f / z = f, whose Jacobian is (1, 0, 0, 0, 1, 0) in u.
void put_on_axis(Sample& sample, int i, float bx, float squares) {
  const TemplatePoints& points = sample.guarded.points();
  const PointResiduals out = sample.residuals.out();
  points.x[i] = points.y[i] = 0.0f;
  points.inverse_depth_focal[i] = 64.0f;
  points.Sxx[i] = 1.0f;
  points.Sxy[i] = points.Syy[i] = 0.0f;
  out.bx[i] = bx;
  out.by[i] = 0.0f;
  out.squares[i] = squares;
}

// With a focal length that is a power of two, everything about such points is exact.
NormalSums sum_on_axis(NormalEquationsFn* normal_equations, Sample& sample) {
  NormalSums sums;
  normal_equations(sample.guarded.points(), sample.residuals.out(), 64.0f, 0.125f, sums);
  return sums;
}

TEST_P(EachNormalEquations, WeighByGemanAndMcClure) {
  for (const auto& [squares, weight] :
       {std::pair{0.0f, 1.0f}, {8.0f, 0.25f}, {24.0f, 0.0625f}, {56.0f, 1.0f / 64.0f}}) {
    Sample sample(1);
    for (int i = 0; i < kPointLanes; ++i) {
      put_on_axis(sample, i, i == 0 ? 32.0f : 0.0f, i == 0 ? squares : -1.0f);
    }
    const NormalSums sums = sum_on_axis(GetParam().normal_equations, sample);
    EXPECT_EQ(sums.H[0], weight) << squares;
    EXPECT_EQ(sums.g[0], 32.0f * weight) << squares;
    EXPECT_EQ(sums.g[4], 32.0f * weight) << squares;
    EXPECT_EQ(sums.g[1], 0.0f);
  }
}

TEST_P(EachNormalEquations, AddUpInTheStatedOrder) {
  Random random(4);
  bool has_mattered = false;
  for (int trial = 0; trial < 50; ++trial) {
    constexpr int kCount = 21;
    Sample sample(kCount);
    std::vector<float> lanes(kPointLanes, 0.0f);
    float in_turn = 0.0f;
    for (int i = 0; i < round_up_to_lanes(kCount); ++i) {
      const auto b =
          static_cast<float>(random.uniform(-1.0, 1.0) * std::pow(10.0, random.integer(0, 9)));
      put_on_axis(sample, i, i < kCount ? b : 0.0f, i < kCount ? 0.0f : -1.0f);
      if (i < kCount) lanes[static_cast<std::size_t>(i % kPointLanes)] += b;
      if (i < kCount) in_turn += b;
    }
    const float expected = ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) +
                           ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
    ASSERT_EQ(sum_on_axis(GetParam().normal_equations, sample).g[0], expected);
    has_mattered = has_mattered || in_turn != expected;
  }
  EXPECT_TRUE(has_mattered);  // or any order would do
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachNormalEquations,
                         ::testing::ValuesIn(test::available_tables()), test::table_name);

}  // namespace
}  // namespace darkling
