// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/frames.h"
#include "geometry/stereo_rig.h"
#include "support/example_rigs.h"
#include "support/random.h"

namespace darkling::test {
namespace {

using testing::HasSubstr;

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct RigCase {
  const char* name;
  StereoRig (*make)();
  int width_px;
};

void PrintTo(const RigCase& one, std::ostream* out) {
  *out << one.name;
}

class AnyRig : public testing::TestWithParam<RigCase> {
 protected:
  void SetUp() override {
    const Result<RectifiedRig> result = rectify_rig(rig, GetParam().width_px);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    rectified = *result;
  }
  // Of the rectified right camera: the place of the raw one, the axes of both.
  Se3 T_body_right() const {
    return rig.T_body_rawright * Se3(rectified.R_rawright_right, Vector3::Zero());
  }

  const StereoRig rig = GetParam().make();
  RectifiedRig rectified;
};

INSTANTIATE_TEST_SUITE_P(Every, AnyRig,
                         testing::Values(RigCase{"Euroc", euroc_rig, 376},
                                         RigCase{"EurocAtSourceWidth", euroc_rig, 0},
                                         RigCase{"Fisheye", fisheye_rig, 256},
                                         RigCase{"UpsideDown", upside_down_rig, 240},
                                         RigCase{"ToedIn", toed_in_rig, 320},
                                         RigCase{"FoldingRadTan", folding_radtan_rig, 160},
                                         RigCase{"FoldingFisheye", folding_fisheye_rig, 160},
                                         RigCase{"KittiAtSourceWidth", kitti_rig, 0}),
                         [](const auto& one) { return one.param.name; });

TEST_P(AnyRig, TurnsBothCamerasToTheSameAxes) {
  for (const Matrix3& R : {rectified.R_rawleft_left, rectified.R_rawright_right}) {
    EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
  }
  EXPECT_LT((rectified.T_body_left.R() - T_body_right().R()).norm(), 1e-9);
}

TEST_P(AnyRig, LaysTheBaselineAlongTheRows) {
  const Se3 T_left_right = rectified.T_body_left.inverse() * T_body_right();
  EXPECT_LT((T_left_right.translation() - Vector3(rectified.baseline_m, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_GT(rectified.baseline_m, 0.05);
}

TEST_P(AnyRig, PutsEveryPointOnOneRowWithItsDisparity) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vector3 p_left(random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(1, 20));
    const Vector3 p_body = rectified.T_body_left * p_left;
    const Vector3 p_right = T_body_right().inverse() * p_body;
    const double f = rectified.focal_px;
    const double u_left = f * p_left.x() / p_left.z() + rectified.cx;
    const double u_right = f * p_right.x() / p_right.z() + rectified.cx;
    const double v_left = f * p_left.y() / p_left.z() + rectified.cy;
    const double v_right = f * p_right.y() / p_right.z() + rectified.cy;
    ASSERT_NEAR(v_left, v_right, 1e-6);
    ASSERT_NEAR(u_left - u_right, f * rectified.baseline_m / p_left.z(), 1e-6);
  }
}

// A rectified pixel, turned into the raw camera, lands where that camera sees the point itself.
TEST_P(AnyRig, LooksThroughTheRawCameras) {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const double u = random.uniform(0, rectified.width);
    const double v = random.uniform(0, rectified.height);
    const double depth_m = random.uniform(2, 20);
    const Vector3 ray = rectified_ray(rectified, u, v);
    const Vector3 p_body = rectified.T_body_left * Vector3(depth_m * ray);
    const Eigen::Vector2d seen = project(rig.left, rig.T_body_rawleft.inverse() * p_body);
    ASSERT_LT((project(rig.left, rectified.R_rawleft_left * ray) - seen).norm(), 1e-6);

    const double disparity = rectified.focal_px * rectified.baseline_m / depth_m;
    const Vector3 ray_right = rectified_ray(rectified, u - disparity, v);
    const Eigen::Vector2d seen_right = project(rig.right, rig.T_body_rawright.inverse() * p_body);
    const Eigen::Vector2d through = project(rig.right, rectified.R_rawright_right * ray_right);
    ASSERT_LT((through - seen_right).norm(), 1e-5);
  }
}

bool sees(const Camera& camera, const Vector3& p) {
  if (camera.distortion != Distortion::kEquidistant && p.z() <= 0.0) return false;
  const Eigen::Vector2d pixel = project(camera, p);
  const auto ray = unproject(camera, pixel);
  return ray && (*ray - p.normalized()).norm() < 1e-9 && pixel.x() >= -0.5 - 1e-9 &&
         pixel.x() <= camera.width - 0.5 + 1e-9 && pixel.y() >= -0.5 - 1e-9 &&
         pixel.y() <= camera.height - 0.5 + 1e-9;
}

// Whether both cameras see the whole edge of a rectangle on the plane z = 1, hence all of it.
bool both_see(const StereoRig& rig, const RectifiedRig& rectified, const Eigen::Vector2d& low,
              const Eigen::Vector2d& high) {
  constexpr int kSteps = 64;
  for (int i = 0; i <= kSteps; ++i) {
    const Eigen::Vector2d at = low + (high - low) * i / kSteps;
    for (const Vector3& ray : {Vector3(at.x(), low.y(), 1.0), Vector3(at.x(), high.y(), 1.0),
                               Vector3(low.x(), at.y(), 1.0), Vector3(high.x(), at.y(), 1.0)}) {
      if (!sees(rig.left, rectified.R_rawleft_left * ray)) return false;
      if (!sees(rig.right, rectified.R_rawright_right * ray)) return false;
    }
  }
  return true;
}

TEST_P(AnyRig, HasOnlyPixelsThatBothCamerasSee) {
  const Vector3 low = rectified_ray(rectified, -0.5, -0.5);
  const Vector3 high = rectified_ray(rectified, rectified.width - 0.5, rectified.height - 0.5);
  EXPECT_TRUE(both_see(rig, rectified, low.head<2>(), high.head<2>()));
}

// Among fields of the same shape, wherever they are: none a fiftieth larger is seen by both. (The
// tie-break towards the axis and the tolerance of the search cost about a hundredth.)
TEST_P(AnyRig, HasAboutTheLargestFieldOfView) {
  const Eigen::Vector2d half(0.51 * rectified.width / rectified.focal_px,
                             0.51 * rectified.height / rectified.focal_px);
  if (half.x() > std::tan(50.0 / kDegrees)) return;  // at the bound of 100°
  for (double x = -0.4; x <= 0.4; x += 0.01) {
    for (double y = -0.4; y <= 0.4; y += 0.01) {
      const Eigen::Vector2d centre(x, y);
      ASSERT_FALSE(both_see(rig, rectified, centre - half, centre + half)) << x << ", " << y;
    }
  }
}

TEST_P(AnyRig, SpansAtMostAHundredDegrees) {
  const double half_width = 0.5 * rectified.width / rectified.focal_px;
  EXPECT_LE(2.0 * std::atan(half_width) * kDegrees, 100.0);
}

TEST(RectifyRig, UsesAllOfTheHundredDegreesOfAFisheye) {
  const auto rectified = rectify_rig(fisheye_rig(), 256);
  ASSERT_TRUE(rectified.has_value());
  EXPECT_NEAR(2.0 * std::atan(128.0 / rectified->focal_px) * kDegrees, 100.0, 0.01);
}

TEST(RectifyRig, SplitsTheTurnBetweenTheCameras) {
  const auto rectified = rectify_rig(toed_in_rig(), 320);
  ASSERT_TRUE(rectified.has_value());
  const auto turn_deg = [](const Matrix3& R) {
    return rotation_angle(Se3(R, Vector3::Zero())) * kDegrees;
  };
  EXPECT_NEAR(turn_deg(rectified->R_rawleft_left), 2.0, 1e-9);
  EXPECT_NEAR(turn_deg(rectified->R_rawright_right), 2.0, 1e-9);
}

TEST(RectifyRig, KeepsTheSourceGeometryOfARectifiedPair) {
  const StereoRig rig = kitti_rig();
  const auto rectified = rectify_rig(rig, 310);
  ASSERT_TRUE(rectified.has_value());
  const double k = 1226.0 / 310.0;
  EXPECT_EQ(rectified->width, 310);
  EXPECT_EQ(rectified->height, 94);
  EXPECT_EQ(rectified->focal_px, rig.left.fx / k);
  EXPECT_EQ(rectified->cx, reduce_pixel(rig.left.cx, k));
  EXPECT_EQ(rectified->cy, reduce_pixel(rig.left.cy, k));
  EXPECT_EQ(rectified->R_rawleft_left, Matrix3::Identity());
  EXPECT_EQ(rectified->R_rawright_right, Matrix3::Identity());
  EXPECT_DOUBLE_EQ(rectified->baseline_m, 0.537150);
}

TEST(RectifyRig, KeepsEveryNumberOfARectifiedPairAtSourceWidth) {
  const StereoRig rig = kitti_rig();
  const auto rectified = rectify_rig(rig, 0);
  ASSERT_TRUE(rectified.has_value());
  EXPECT_EQ(rectified->width, 1226);
  EXPECT_EQ(rectified->height, 370);
  EXPECT_EQ(rectified->focal_px, rig.left.fx);
  EXPECT_DOUBLE_EQ(rectified->cx, rig.left.cx);
  EXPECT_DOUBLE_EQ(rectified->cy, rig.left.cy);
  EXPECT_EQ(rectified->T_body_left.matrix(), rig.T_body_rawleft.matrix());
}

TEST(RectifyRig, DoesNotTakeATurnOfATenthOfAPixelForRectified) {
  StereoRig rig = kitti_rig();
  rig.T_body_rawright = rig.T_body_rawright * Se3(so3_exp({0.0, 0.0, 2e-4}), Vector3::Zero());
  const auto rectified = rectify_rig(rig, 310);
  ASSERT_TRUE(rectified.has_value());
  EXPECT_GT((rectified->R_rawright_right - Matrix3::Identity()).norm(), 1e-5);
}

TEST(RectifyRig, GivesTheSameFieldOfViewAtEveryWidth) {
  const auto large = rectify_rig(euroc_rig(), 752);
  const auto small = rectify_rig(euroc_rig(), 188);
  ASSERT_TRUE(large.has_value() && small.has_value());
  EXPECT_NEAR(large->focal_px / small->focal_px, 4.0, 1e-6);
  EXPECT_NEAR(reduce_pixel(large->cx, 4.0), small->cx, 1e-6);
  EXPECT_NEAR(reduce_pixel(large->cy, 4.0), small->cy, 1e-6);
}

TEST(RectifyRig, RefusesWidthsOutOfRange) {
  for (const int width_px : {-1, 1, 31, 753, 100'000}) {
    const auto result = rectify_rig(euroc_rig(), width_px);
    ASSERT_FALSE(result.has_value()) << width_px;
    EXPECT_EQ(result.error().code, ExitCode::kConfiguration);
    EXPECT_THAT(result.error().message, HasSubstr(std::to_string(width_px)));
    EXPECT_THAT(result.error().message, HasSubstr("32 to 752"));
  }
}

TEST(RectifyRig, RefusesAThumbnailWithoutHeight) {
  StereoRig rig = kitti_rig();
  rig.left.height = rig.right.height = 100;
  rig.left.cy = rig.right.cy = 50.0;
  const auto result = rectify_rig(rig, 64);
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().message, HasSubstr("5 px high; allowed: at least 8"));
}

TEST(RectifyRig, RefusesWhatTheCheckOfTheRigRefuses) {
  StereoRig rig = euroc_rig();
  std::swap(rig.T_body_rawleft, rig.T_body_rawright);
  const auto result = rectify_rig(rig, 320);
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().message, HasSubstr("swapped"));
}

TEST(RectifyRig, RefusesCamerasThatShareTooLittle) {
  StereoRig rig = toed_in_rig();  // made long lenses, 7° across, that look 20° apart
  for (Camera* camera : {&rig.left, &rig.right}) camera->fx = camera->fy = 5000.0;
  rig.T_body_rawright =
      rig.T_body_rawright * Se3(so3_exp({0.0, 24.0 / kDegrees, 0.0}), Vector3::Zero());
  const auto result = rectify_rig(rig, 320);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(result.error().message, HasSubstr("0° across; allowed: at least 10°"));
}

}  // namespace
}  // namespace darkling::test
