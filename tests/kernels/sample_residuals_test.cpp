// SPDX-License-Identifier: Apache-2.0
#include "kernels/sample_residuals.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "support/guarded_points.h"
#include "support/pixels.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedPoints;
using test::GuardedResiduals;
using test::Random;

constexpr int kWidth = 43;
constexpr int kHeight = 31;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

PlanePatch random_patch(Random& random) {
  PlanePatch patch;
  for (int c = 0; c < kPlaneCount; ++c) {
    patch.reference[c] = static_cast<std::uint8_t>(random.integer(0, 255));
    patch.gx2[c] = static_cast<std::int16_t>(random.integer(-255, 255));
    patch.gy2[c] = static_cast<std::int16_t>(random.integer(-255, 255));
  }
  return patch;
}

// Points all over the image and beyond; behind the last one there is no number.
void fill_randomly(TemplatePoints& points, Random& random) {
  for (int i = 0; i < round_up_to_lanes(points.count); ++i) {
    const bool is_point = i < points.count;
    points.x[i] = is_point ? static_cast<float>(random.uniform(-kWidth, kWidth)) : kNaN;
    points.y[i] = is_point ? static_cast<float>(random.uniform(-kHeight, kHeight)) : kInfinity;
    points.inverse_depth_focal[i] = is_point ? static_cast<float>(random.uniform(0.0, 40.0)) : kNaN;
    points.patches[i] = random_patch(random);
  }
}

// Puts the point (x, y) from the principal point on (x + cx, y + cy), exactly: f is a power of two.
PointWarp identity_warp(float cx, float cy) {
  return {.A = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .a = {}, .focal_px = 32.0f, .cx = cx, .cy = cy};
}

// A motion of some pixels in every direction.
PointWarp random_warp(Random& random) {
  PointWarp warp = identity_warp(20.5f, 15.25f);
  for (float& entry : warp.A) entry += static_cast<float>(random.uniform(-0.05, 0.05));
  for (float& entry : warp.a) entry = static_cast<float>(random.uniform(-0.2, 0.2));
  return warp;
}

struct ExpectedPoint {
  double u = 0.0;
  double v = 0.0;
  bool is_inside = false;
  std::array<double, kPlaneCount> r = {};
};

// The contract in doubles, with bilinear sampling as two steps of linear interpolation.
ExpectedPoint residual_oracle(const TemplatePoints& points, int i, const PointWarp& warp,
                              const ImageView<const std::uint8_t>& planes) {
  const double ray[3] = {points.x[i], points.y[i], warp.focal_px};
  double P[3] = {};
  for (int k = 0; k < 3; ++k) {
    P[k] = double{warp.a[k]} * points.inverse_depth_focal[i];
    for (int j = 0; j < 3; ++j) P[k] += double{warp.A[3 * k + j]} * ray[j];
  }
  ExpectedPoint out;
  out.u = warp.focal_px * P[0] / P[2] + warp.cx;
  out.v = warp.focal_px * P[1] / P[2] + warp.cy;
  out.is_inside =
      P[2] > 0.0 && out.u >= 1.0 && out.v >= 1.0 && out.u < kWidth - 2 && out.v < kHeight - 2;
  if (!out.is_inside) return out;
  const int x = static_cast<int>(std::floor(out.u));
  const int y = static_cast<int>(std::floor(out.v));
  for (int c = 0; c < kPlaneCount; ++c) {
    const auto phi = [&](int k, int j) { return 1.0 * planes.at(k * kPlaneCount + c, j); };
    const double upper = std::lerp(phi(x, y), phi(x + 1, y), out.u - x);
    const double lower = std::lerp(phi(x, y + 1), phi(x + 1, y + 1), out.u - x);
    out.r[c] = std::lerp(upper, lower, out.v - y) - points.patches[i].reference[c];
  }
  return out;
}

// Whether all three sums of point `i` are what residuals give that are less than `r_bound` off.
::testing::AssertionResult is_near(const PointResiduals& out, int i, const ExpectedPoint& expected,
                                   const PlanePatch& patch, double r_bound) {
  double sums[3] = {};
  double bounds[3] = {};
  for (int c = 0; c < kPlaneCount; ++c) {
    const double r = expected.r[static_cast<std::size_t>(c)];
    sums[0] += 0.5 * patch.gx2[c] * r;
    sums[1] += 0.5 * patch.gy2[c] * r;
    sums[2] += r * r;
    bounds[0] += 0.5 * std::abs(patch.gx2[c]) * r_bound;
    bounds[1] += 0.5 * std::abs(patch.gy2[c]) * r_bound;
    bounds[2] += (2.0 * std::abs(r) + r_bound) * r_bound;
  }
  const float found[3] = {out.bx[i], out.by[i], out.squares[i]};
  for (int k = 0; k < 3; ++k) {
    const double to_float = 1e-6 * std::abs(sums[k]);
    if (std::abs(double{found[k]} - sums[k]) <= bounds[k] + to_float) continue;
    return ::testing::AssertionFailure() << "sum " << k << " is " << found[k] << ", not " << sums[k]
                                         << " give or take " << bounds[k];
  }
  return ::testing::AssertionSuccess();
}

constexpr double kResidualBound = 1.0 / 64.0 + 1.0 / 128.0;

class EachSampleResiduals : public ::testing::TestWithParam<KernelTable> {
 protected:
  EachSampleResiduals() { test::fill_image(planes_.view(), Fill::kUniform, 11); }

  // All bytes of the three arrays, guards checked.
  std::vector<float> sample(SampleResidualsFn* sample_residuals, const TemplatePoints& points,
                            const PointWarp& warp, int& visible) {
    GuardedResiduals residuals(points.count);
    const PointResiduals out = residuals.out();
    visible = sample_residuals(points, warp, planes_.view(), out);
    EXPECT_TRUE(residuals.padding_is_untouched());
    std::vector<float> all;
    const int count = round_up_to_lanes(points.count);
    for (const float* array : {out.bx, out.by, out.squares}) {
      all.insert(all.end(), array, array + count);
    }
    return all;
  }

  GuardedImage<std::uint8_t> planes_{
      {.width = kWidth * kPlaneCount, .height = kHeight, .row_padding = 3}};
};

// Positions are whole 1/4096 px, so that only weights and residuals are rounded.
TEST_P(EachSampleResiduals, ErrByLessThanTheContractAllowsAtExactPositions) {
  Random random(1);
  GuardedPoints guarded(800);
  TemplatePoints& points = guarded.points();
  GuardedResiduals residuals(points.count);
  const PointResiduals out = residuals.out();
  for (const bool is_chequered : {false, true}) {  // the most that a rounded weight can do
    for (int i = 0; is_chequered && i < kWidth * kPlaneCount * kHeight; ++i) {
      const int x = i % (kWidth * kPlaneCount);
      const int y = i / (kWidth * kPlaneCount);
      planes_.view().at(x, y) = (x / kPlaneCount + y) % 2 == 0 ? 255 : 0;
    }
    fill_randomly(points, random);
    for (int i = 0; i < points.count; ++i) {
      points.x[i] = static_cast<float>(random.integer(4096, (kWidth - 2) * 4096 - 1)) / 4096.0f;
      points.y[i] = static_cast<float>(random.integer(4096, (kHeight - 2) * 4096 - 1)) / 4096.0f;
    }
    const PointWarp warp = identity_warp(0.0f, 0.0f);
    ASSERT_EQ(GetParam().sample_residuals(points, warp, planes_.view(), out), points.count);
    for (int i = 0; i < points.count && !HasFailure(); ++i) {
      const ExpectedPoint expected = residual_oracle(points, i, warp, planes_.view());
      ASSERT_EQ(expected.u, static_cast<double>(points.x[i]));
      ASSERT_TRUE(is_near(out, i, expected, points.patches[i], kResidualBound));
    }
  }
}

TEST(SumsOfAPoint, AreNotNearWhenOneOfThemIsTwentyFiveOff) {
  Random random(4);
  const PlanePatch patch = random_patch(random);
  ExpectedPoint expected;
  float sums[3] = {};
  for (int c = 0; c < kPlaneCount; ++c) {
    expected.r[static_cast<std::size_t>(c)] = 5.0 + c;
    sums[0] += 0.5f * patch.gx2[c] * static_cast<float>(5 + c);
    sums[1] += 0.5f * patch.gy2[c] * static_cast<float>(5 + c);
    sums[2] += static_cast<float>((5 + c) * (5 + c));
  }
  const PointResiduals out = {&sums[0], &sums[1], &sums[2]};
  EXPECT_TRUE(is_near(out, 0, expected, patch, kResidualBound));
  for (float& sum : sums) {
    const float right = sum;
    sum += 25.0f;  // 8 · 127.5 · 0.0234 is the most that may be allowed
    EXPECT_FALSE(is_near(out, 0, expected, patch, kResidualBound));
    sum = right;
  }
}

// Whether rounding to floats may put a point on the other side of the border.
bool is_near_border(const ExpectedPoint& point) {
  constexpr double kFloat_px = 1e-4;
  const auto is_near = [](double value, double edge) { return std::abs(value - edge) < kFloat_px; };
  return is_near(point.u, 1.0) || is_near(point.v, 1.0) || is_near(point.u, kWidth - 2) ||
         is_near(point.v, kHeight - 2);
}

TEST_P(EachSampleResiduals, EqualTheOracleToTheRoundingOfPositionsUnderEveryMotion) {
  // Positions are cut to 1/4096 px, on slopes of up to 255 a pixel either way.
  constexpr double kBound = kResidualBound + 2.0 * 255.0 * (1.0 / 4096.0 + 1e-5);
  Random random(2);
  int inside = 0;
  int outside = 0;
  for (int trial = 0; trial < 40; ++trial) {
    GuardedPoints guarded(100);
    const TemplatePoints& points = guarded.points();
    fill_randomly(guarded.points(), random);
    GuardedResiduals residuals(points.count);
    const PointResiduals out = residuals.out();
    const PointWarp warp = random_warp(random);
    const int returned = GetParam().sample_residuals(points, warp, planes_.view(), out);
    int visible = 0;
    for (int i = 0; i < points.count && !HasFailure(); ++i) {
      visible += out.squares[i] >= 0.0f ? 1 : 0;
      const ExpectedPoint expected = residual_oracle(points, i, warp, planes_.view());
      if (is_near_border(expected)) continue;
      SCOPED_TRACE(testing::Message() << "u " << expected.u << " v " << expected.v);
      ASSERT_EQ(out.squares[i] >= 0.0f, expected.is_inside);
      ++(expected.is_inside ? inside : outside);
      if (!expected.is_inside) continue;
      ASSERT_TRUE(is_near(out, i, expected, points.patches[i], kBound));
    }
    ASSERT_EQ(returned, visible);
  }
  EXPECT_GT(inside, 500);  // or nothing was compared
  EXPECT_GT(outside, 500);
}

TEST_P(EachSampleResiduals, EqualTheReferenceBitForBitForEveryCount) {
  Random random(3);
  for (int count = 0; count <= 25; ++count) {
    for (int trial = 0; trial < 8; ++trial) {
      SCOPED_TRACE(count);
      GuardedPoints guarded(count);
      fill_randomly(guarded.points(), random);
      const PointWarp warp = random_warp(random);
      int visible = 0;
      int expected_visible = 0;
      const auto found = sample(GetParam().sample_residuals, guarded.points(), warp, visible);
      const auto expected = sample(sample_residuals_ref, guarded.points(), warp, expected_visible);
      ASSERT_EQ(visible, expected_visible);
      ASSERT_TRUE(guarded.padding_is_untouched());
      if (count == 0) continue;  // memcmp may not see the null pointer of an empty vector
      ASSERT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(float)), 0);
    }
  }
}

TEST_P(EachSampleResiduals, WriteWhatStandsBehindTheLastPointAsNotInTheImage) {
  for (int count = 1; count <= 25; ++count) {
    GuardedPoints guarded(count);
    TemplatePoints& points = guarded.points();
    for (int i = 0; i < round_up_to_lanes(count); ++i) {  // all would be visible
      points.x[i] = points.y[i] = 5.5f;
      points.inverse_depth_focal[i] = 1.0f;
      points.patches[i] = {};
    }
    GuardedResiduals residuals(count);
    const PointResiduals out = residuals.out();
    EXPECT_EQ(GetParam().sample_residuals(points, identity_warp(0, 0), planes_.view(), out), count);
    for (int i = count; i < round_up_to_lanes(count); ++i) {
      EXPECT_EQ(out.squares[i], -1.0f) << count;
      EXPECT_EQ(out.bx[i], 0.0f) << count;
      EXPECT_EQ(out.by[i], 0.0f) << count;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachSampleResiduals,
                         ::testing::ValuesIn(test::available_tables()), test::table_name);

}  // namespace
}  // namespace darkling
