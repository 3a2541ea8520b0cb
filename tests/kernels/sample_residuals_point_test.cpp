// SPDX-License-Identifier: Apache-2.0
// One point alone: where the image ends, and what is no position.
#include <cmath>
#include <limits>

#include "support/guarded_points.h"
#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedPoints;
using test::GuardedResiduals;

constexpr int kWidth = 43;
constexpr int kHeight = 31;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Puts the point (x, y) from the principal point on (x + cx, y + cy), exactly: f is a power of two.
PointWarp identity_warp(float cx, float cy) {
  return {.A = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .a = {}, .focal_px = 32.0f, .cx = cx, .cy = cy};
}

// The point and the planes, right before a guard page.
class OnePoint : public ::testing::TestWithParam<KernelTable> {
 protected:
  OnePoint() {
    test::fill_image(planes_.view(), Fill::kUniform, 11);
    point().inverse_depth_focal[0] = 1.0f;
    point().patches[0] = {};
  }

  // @return whether it is in the image.
  bool sample_one(const PointWarp& warp) {
    const int visible = GetParam().sample_residuals(point(), warp, planes_.view(), out_);
    EXPECT_EQ(visible, out_.squares[0] >= 0.0f ? 1 : 0);
    EXPECT_TRUE(visible == 1 || (out_.bx[0] == 0.0f && out_.by[0] == 0.0f));
    return visible == 1;
  }
  bool sample_at(float u, float v) {
    point().x[0] = u;
    point().y[0] = v;
    return sample_one(identity_warp(0.0f, 0.0f));
  }
  TemplatePoints& point() { return guarded_.points(); }

  GuardedImage<std::uint8_t> planes_{
      {.width = kWidth * kPlaneCount, .height = kHeight, .row_padding = 3}};
  GuardedPoints guarded_{1};
  GuardedResiduals residuals_{1};
  PointResiduals out_ = residuals_.out();
};

TEST_P(OnePoint, IsInTheImageUpToThePixelBeforeTheBorderAndNotBeyond) {
  const float right = kWidth - 2;
  const float bottom = kHeight - 2;
  const float before_right = std::nextafter(right, 0.0f);
  const float before_bottom = std::nextafter(bottom, 0.0f);
  const float before_one = std::nextafter(1.0f, 0.0f);
  EXPECT_TRUE(sample_at(1.0f, 1.0f));
  EXPECT_TRUE(sample_at(before_right, before_bottom));
  EXPECT_TRUE(sample_at(before_right, 1.0f));
  EXPECT_TRUE(sample_at(1.0f, before_bottom));
  for (const float u : {before_one, right, -1.0f, -1e9f, 1e9f}) {
    EXPECT_FALSE(sample_at(u, 5.0f)) << u;
  }
  for (const float v : {before_one, bottom, -1.0f, -1e9f, 1e9f}) {
    EXPECT_FALSE(sample_at(5.0f, v)) << v;
  }
}

TEST_P(OnePoint, IsNotInTheImageAtAPositionThatIsNoNumber) {
  EXPECT_TRUE(sample_at(5.0f, 5.0f));
  for (const float value : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_FALSE(sample_at(value, 5.0f)) << value;
    EXPECT_FALSE(sample_at(5.0f, value)) << value;
    point().x[0] = point().y[0] = 5.0f;
    PointWarp warp = identity_warp(0.0f, 0.0f);
    warp.A[0] = value;
    EXPECT_FALSE(sample_one(warp)) << value;
    point().inverse_depth_focal[0] = value;
    EXPECT_FALSE(sample_one(identity_warp(0.0f, 0.0f))) << value;  // 0 · ∞
    point().inverse_depth_focal[0] = 1.0f;
  }
}

TEST_P(OnePoint, IsNotSeenBehindInOrBesideTheCamera) {
  point().x[0] = point().y[0] = 0.0f;
  point().inverse_depth_focal[0] = 1.0f;
  EXPECT_TRUE(sample_one(identity_warp(20.5f, 15.25f)));
  for (const float z : {-32.0f, -33.0f, -1000.0f, kNaN}) {
    PointWarp warp = identity_warp(20.5f, 15.25f);
    warp.a[2] = z;  // f + z · s: in the plane of the camera, and behind it
    EXPECT_FALSE(sample_one(warp)) << z;
  }
}

TEST_P(OnePoint, IsZeroWhereThePlanesAreTheReference) {
  for (int c = 0; c < kPlaneCount; ++c) {
    point().patches[0].reference[c] = planes_.view().at(21 * kPlaneCount + c, 15);
    point().patches[0].gx2[c] = 100;
    point().patches[0].gy2[c] = -100;
  }
  ASSERT_TRUE(sample_at(21.0f, 15.0f));
  EXPECT_EQ(out_.squares[0], 0.0f);
  EXPECT_EQ(out_.bx[0], 0.0f);
  EXPECT_EQ(out_.by[0], 0.0f);
}

TEST_P(OnePoint, ReachesItsGreatestSumsWithoutOverflow) {
  for (const std::uint8_t level : {std::uint8_t{255}, std::uint8_t{0}}) {
    const float sign = level == 255 ? 1.0f : -1.0f;
    test::fill_image(planes_.view(), Fill::kConstant, level);
    for (int c = 0; c < kPlaneCount; ++c) {
      point().patches[0].reference[c] = static_cast<std::uint8_t>(255 - level);
      point().patches[0].gx2[c] = 255;
      point().patches[0].gy2[c] = -255;
    }
    for (const float at : {5.0f, 5.25f, 5.0f + 4095.0f / 4096.0f}) {
      ASSERT_TRUE(sample_at(at, at));
      EXPECT_EQ(out_.squares[0], 8.0f * 255.0f * 255.0f);
      EXPECT_EQ(out_.bx[0], sign * 4.0f * 255.0f * 255.0f);
      EXPECT_EQ(out_.by[0], -sign * 4.0f * 255.0f * 255.0f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, OnePoint, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
