// SPDX-License-Identifier: Apache-2.0
#include "kernels/sample_residuals.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "support/pixels.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::Random;

constexpr int kWidth = 43;
constexpr int kHeight = 31;

TemplatePoint random_point(Random& random) {
  TemplatePoint point;
  point.x = static_cast<float>(random.uniform(-kWidth, kWidth));
  point.y = static_cast<float>(random.uniform(-kHeight, kHeight));
  point.inverse_depth_focal = static_cast<float>(random.uniform(0.0, 40.0));
  for (int c = 0; c < kPlaneCount; ++c) {
    point.reference[c] = static_cast<std::uint8_t>(random.integer(0, 255));
    point.gx2[c] = static_cast<std::int16_t>(random.integer(-255, 255));
    point.gy2[c] = static_cast<std::int16_t>(random.integer(-255, 255));
  }
  return point;
}

std::vector<TemplatePoint> random_points(int count, Random& random) {
  std::vector<TemplatePoint> points;
  for (int i = 0; i < count; ++i) points.push_back(random_point(random));
  return points;
}

PointWarp identity_warp() {
  PointWarp warp;
  warp.A = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  warp.focal_px = 40.0f;
  warp.cx = 20.5f;
  warp.cy = 15.25f;
  return warp;
}

// A motion of some pixels in every direction.
PointWarp random_warp(Random& random) {
  PointWarp warp = identity_warp();
  for (float& entry : warp.A) entry += static_cast<float>(random.uniform(-0.05, 0.05));
  for (float& entry : warp.a) entry = static_cast<float>(random.uniform(-0.2, 0.2));
  return warp;
}

struct ExpectedResidual {
  double u = 0.0;
  double v = 0.0;
  double bx = 0.0;
  double by = 0.0;
  double distance = -1.0;
};

// The contract in doubles, with bilinear sampling as two steps of linear interpolation.
ExpectedResidual residual_oracle(const TemplatePoint& p, const PointWarp& warp,
                                 const ImageView<const std::uint8_t>& planes) {
  const double ray[3] = {p.x, p.y, warp.focal_px};
  double P[3] = {};
  for (int i = 0; i < 3; ++i) {
    P[i] = double{warp.a[i]} * p.inverse_depth_focal;
    for (int j = 0; j < 3; ++j) P[i] += double{warp.A[3 * i + j]} * ray[j];
  }
  ExpectedResidual out;
  out.u = warp.focal_px * P[0] / P[2] + warp.cx;
  out.v = warp.focal_px * P[1] / P[2] + warp.cy;
  const int width = planes.width / kPlaneCount;
  const bool is_inside =
      P[2] > 0.0 && out.u >= 1.0 && out.v >= 1.0 && out.u < width - 2 && out.v < planes.height - 2;
  if (!is_inside) return out;
  const int x = static_cast<int>(std::floor(out.u));
  const int y = static_cast<int>(std::floor(out.v));
  double squares = 0.0;
  for (int c = 0; c < kPlaneCount; ++c) {
    const auto phi = [&](int i, int j) { return 1.0 * planes.at(i * kPlaneCount + c, j); };
    const double upper = std::lerp(phi(x, y), phi(x + 1, y), out.u - x);
    const double lower = std::lerp(phi(x, y + 1), phi(x + 1, y + 1), out.u - x);
    const double r = std::lerp(upper, lower, out.v - y) - p.reference[c];
    out.bx += 0.5 * p.gx2[c] * r;
    out.by += 0.5 * p.gy2[c] * r;
    squares += r * r;
  }
  out.distance = std::sqrt(squares / kPlaneCount);
  return out;
}

// Whether rounding to floats may put a point on the other side of the border.
bool is_near_border(const ExpectedResidual& point) {
  constexpr double kFloat_px = 1e-4;
  const auto is_near = [](double value, double edge) { return std::abs(value - edge) < kFloat_px; };
  return is_near(point.u, 1.0) || is_near(point.v, 1.0) || is_near(point.u, kWidth - 2) ||
         is_near(point.v, kHeight - 2);
}

class EachSampleResiduals : public ::testing::TestWithParam<KernelTable> {
 protected:
  EachSampleResiduals() { test::fill_image(planes_.view(), Fill::kUniform, 11); }

  GuardedImage<std::uint8_t> planes_{
      {.width = kWidth * kPlaneCount, .height = kHeight, .row_padding = 3}};
};

TEST_P(EachSampleResiduals, EqualsTheOracleToTheRoundingOfFloats) {
  Random random(1);
  int seen = 0;
  int unseen = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<TemplatePoint> points = random_points(100, random);
    const PointWarp warp = random_warp(random);
    std::vector<PointResidual> out(points.size());
    int visible = 0;
    const int returned = GetParam().sample_residuals(points, warp, planes_.view(), out);
    for (std::size_t i = 0; i < points.size(); ++i) {
      visible += out[i].distance >= 0.0f ? 1 : 0;
      const ExpectedResidual expected = residual_oracle(points[i], warp, planes_.view());
      if (is_near_border(expected)) continue;
      SCOPED_TRACE(testing::Message() << "u " << expected.u << " v " << expected.v);
      ASSERT_EQ(out[i].distance < 0.0f, expected.distance < 0.0);
      ++(expected.distance < 0.0 ? unseen : seen);
      if (expected.distance < 0.0) continue;
      // Positions to 1e-5 px times slopes of up to 255 a pixel in each of eight planes.
      ASSERT_NEAR(out[i].distance, expected.distance, 0.02);
      ASSERT_NEAR(out[i].bx, expected.bx, 8.0);
      ASSERT_NEAR(out[i].by, expected.by, 8.0);
    }
    ASSERT_EQ(returned, visible);
  }
  EXPECT_GT(seen, 500);  // or nothing was compared
  EXPECT_GT(unseen, 500);
}

TEST_P(EachSampleResiduals, EqualsTheReferenceBitForBitForEveryCount) {
  Random random(2);
  for (int count = 0; count <= 40; ++count) {
    SCOPED_TRACE(count);
    const std::vector<TemplatePoint> points = random_points(count, random);
    const PointWarp warp = random_warp(random);
    std::vector<PointResidual> out(points.size());
    std::vector<PointResidual> expected(points.size());
    EXPECT_EQ(GetParam().sample_residuals(points, warp, planes_.view(), out),
              sample_residuals_ref(points, warp, planes_.view(), expected));
    if (count == 0) continue;  // memcmp may not see the null pointer of an empty vector
    ASSERT_EQ(std::memcmp(out.data(), expected.data(), out.size() * sizeof(PointResidual)), 0);
  }
}

// A point that lands on (u, v) exactly under the identity.
TemplatePoint point_at(const PointWarp& warp, float u, float v) {
  TemplatePoint point;
  point.x = u - warp.cx;
  point.y = v - warp.cy;
  return point;
}

TEST_P(EachSampleResiduals, StaysInsideOnTheLastPixelsAndCountsTheBorderAsUnseen) {
  const PointWarp warp = identity_warp();
  const float right = kWidth - 2;
  const float bottom = kHeight - 2;
  const struct {
    float u;
    float v;
    bool is_seen;
  } cases[] = {{1.0f, 1.0f, true},          {right - 0.25f, bottom - 0.25f, true},
               {0.75f, 5.0f, false},        {5.0f, 0.75f, false},
               {right, 5.0f, false},        {5.0f, bottom, false},
               {-1000.0f, 5.0f, false},     {5.0f, 1e9f, false},
               {right - 0.25f, 1.0f, true}, {1.0f, bottom - 0.25f, true}};
  for (const auto& at : cases) {
    const TemplatePoint point = point_at(warp, at.u, at.v);
    PointResidual out;
    EXPECT_EQ(GetParam().sample_residuals({&point, 1}, warp, planes_.view(), {&out, 1}),
              at.is_seen ? 1 : 0)
        << at.u << " " << at.v;
    EXPECT_EQ(out.distance >= 0.0f, at.is_seen) << at.u << " " << at.v;
  }
}

TEST_P(EachSampleResiduals, DoesNotSeeWhatLiesBehindInOrBesideTheCamera) {
  TemplatePoint point = point_at(identity_warp(), 20.5f, 15.25f);
  point.inverse_depth_focal = 1.0f;
  for (const float z : {-40.0f, -41.0f, -1000.0f, std::numeric_limits<float>::quiet_NaN()}) {
    PointWarp warp = identity_warp();
    warp.a[2] = z;  // f + z · s: in the plane of the camera, and behind it
    PointResidual out;
    EXPECT_EQ(GetParam().sample_residuals({&point, 1}, warp, planes_.view(), {&out, 1}), 0) << z;
    EXPECT_LT(out.distance, 0.0f);
  }
}

TEST_P(EachSampleResiduals, IsZeroWhereThePlanesAreTheReference) {
  const PointWarp warp = identity_warp();
  PointWarp whole = warp;
  whole.cy = 15.0f;
  TemplatePoint point;
  point.x = 0.5f;  // pixel 21
  for (int c = 0; c < kPlaneCount; ++c) {
    point.reference[c] = planes_.view().at(21 * kPlaneCount + c, 15);
    point.gx2[c] = 100;
  }
  PointResidual out;
  ASSERT_EQ(GetParam().sample_residuals({&point, 1}, whole, planes_.view(), {&out, 1}), 1);
  EXPECT_EQ(out.distance, 0.0f);
  EXPECT_EQ(out.bx, 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachSampleResiduals,
                         ::testing::ValuesIn(test::available_tables()), test::table_name);

}  // namespace
}  // namespace darkling
