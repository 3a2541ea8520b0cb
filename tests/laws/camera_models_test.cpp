// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "geometry/camera.h"
#include "support/camera_cases.h"
#include "support/numeric_jacobian.h"
#include "support/random.h"

namespace darkling::test {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

class CameraModel : public testing::TestWithParam<CameraCase> {
 protected:
  const Camera& camera() const { return GetParam().camera; }
  double domain_rad() const { return GetParam().domain_rad; }
};

INSTANTIATE_TEST_SUITE_P(Every, CameraModel, testing::ValuesIn(camera_cases()),
                         [](const auto& one) { return one.param.name; });

Vector3 ray_at(double angle_rad, double azimuth_rad) {
  return {std::sin(angle_rad) * std::cos(azimuth_rad), std::sin(angle_rad) * std::sin(azimuth_rad),
          std::cos(angle_rad)};
}

// Points at up to `share` of the domain's angle from the axis, 0.2 to 50 m away.
std::vector<Vector3> points_in_view(const CameraCase& of, double share, int count) {
  Random random(7);
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = random.uniform(0.0, share * of.domain_rad);
    points.push_back(random.uniform(0.2, 50.0) *
                     ray_at(angle_rad, random.uniform(0.0, 2.0 * std::numbers::pi)));
  }
  return points;
}

TEST_P(CameraModel, FindsTheRayOfEveryProjectedPoint) {
  for (const Vector3& p : points_in_view(GetParam(), 0.97, 3000)) {
    const auto ray = unproject(camera(), project(camera(), p));
    ASSERT_TRUE(ray.has_value()) << p.transpose();
    ASSERT_LT((*ray - p.normalized()).norm(), 1e-10) << p.transpose();
  }
}

TEST_P(CameraModel, ProjectsTheRayOfEveryPixelBackToIt) {
  int refused = 0;
  for (double v = -0.5; v < camera().height; v += 7.25) {
    for (double u = -0.5; u < camera().width; u += 7.25) {
      const auto ray = unproject(camera(), {u, v});
      if (!ray) {
        ++refused;
        continue;
      }
      ASSERT_NEAR(ray->norm(), 1.0, 1e-14);
      ASSERT_LT((project(camera(), *ray) - Eigen::Vector2d(u, v)).norm(), 1e-9) << u << ", " << v;
    }
  }
  EXPECT_EQ(refused == 0, GetParam().covers_image) << refused << " pixels refused";
}

// Far outside the image too, a pixel has its own ray inside the domain, or none.
TEST_P(CameraModel, NeverAnswersWithARayBeyondItsDomain) {
  const double beyond_rad = GetParam().covers_image ? std::numbers::pi : 1.04 * domain_rad();
  for (double v = -900.0; v < 1400.0; v += 23.7) {
    for (double u = -900.0; u < 1900.0; u += 23.7) {
      const auto ray = unproject(camera(), {u, v});
      if (!ray) continue;
      ASSERT_LT((project(camera(), *ray) - Eigen::Vector2d(u, v)).norm(), 1e-7) << u << ", " << v;
      const double angle_rad = std::atan2(ray->head<2>().norm(), ray->z());
      ASSERT_LT(angle_rad, beyond_rad) << u << ", " << v;
    }
  }
}

TEST_P(CameraModel, HasTheOpticalAxisAtItsPrincipalPoint) {
  const Eigen::Vector2d principal(camera().cx, camera().cy);
  EXPECT_EQ(project(camera(), Vector3(0.0, 0.0, 2.0)), principal);
  const auto ray = unproject(camera(), principal);
  ASSERT_TRUE(ray.has_value());
  EXPECT_EQ(*ray, Vector3::UnitZ());
}

TEST_P(CameraModel, IsContinuousAroundTheOpticalAxis) {
  const Eigen::Vector2d principal(camera().cx, camera().cy);
  for (const double x : {1e-300, 1e-160, 1e-12, 1e-8}) {
    Matrix23 J;
    const Eigen::Vector2d pixel = project(camera(), Vector3(x, -x, 2.0), J);
    EXPECT_LT((pixel - principal).norm(), 1e3 * x + 1e-12);
    Matrix23 J_axis;
    static_cast<void>(project(camera(), Vector3(0.0, 0.0, 2.0), J_axis));
    EXPECT_LT(jacobian_error(J, J_axis), 1e-7);
  }
}

TEST_P(CameraModel, HasTheJacobianThatDifferencesGive) {
  for (const Vector3& p : points_in_view(GetParam(), 0.9, 300)) {
    const Vector3 ray = p.normalized();
    Matrix23 J;
    const Eigen::Vector2d pixel = project(camera(), ray, J);
    ASSERT_EQ(pixel, project(camera(), ray));
    const auto f = [&](const Vector3& q) { return project(camera(), q); };
    // Steps well below the distance to the plane z = 0, where a pinhole has its pole.
    const double step = 2e-3 * std::abs(ray.z());
    const Matrix23 expected = numeric_jacobian<2, 3>(f, ray, std::max(step, 1e-5));
    ASSERT_LT(jacobian_error(J, expected), 1e-7) << ray.transpose();
  }
}

TEST_P(CameraModel, SeesOnlyDirections) {
  for (const Vector3& p : points_in_view(GetParam(), 0.9, 100)) {
    Matrix23 J;
    const Eigen::Vector2d pixel = project(camera(), p, J);
    EXPECT_LT((project(camera(), 3.7 * p) - pixel).norm(), 1e-9);
    EXPECT_LT((J * p).norm(), 1e-9 * (1.0 + pixel.norm()));
  }
}

TEST_P(CameraModel, RefusesPixelsThatAreNotNumbers) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(unproject(camera(), {kNone, 10.0}).has_value());
  EXPECT_FALSE(unproject(camera(), {10.0, kFar}).has_value());
}

// OpenCV's own projection: calib3d for the first two models, its fisheye module for the third.
std::vector<cv::Point2d> project_by_opencv(const Camera& camera,
                                           const std::vector<cv::Point3d>& points) {
  const cv::Matx33d K(camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
  const auto& k = camera.coefficients;
  const cv::Vec4d coefficients(k[0], k[1], k[2], k[3]);
  const cv::Vec3d zero(0.0, 0.0, 0.0);
  std::vector<cv::Point2d> pixels;
  if (camera.distortion == Distortion::kEquidistant) {
    cv::fisheye::projectPoints(points, pixels, zero, zero, K, coefficients);
  } else {
    cv::projectPoints(points, zero, zero, K, coefficients, pixels);
  }
  return pixels;
}

TEST_P(CameraModel, ProjectsAsOpenCvDoes) {
  std::vector<cv::Point3d> points;
  for (const Vector3& p : points_in_view(GetParam(), 1.0, 3000)) {
    const double angle_rad = std::atan2(p.head<2>().norm(), p.z());
    if (angle_rad < 1.45) points.emplace_back(p.x(), p.y(), p.z());  // OpenCV knows z > 0 only
  }
  const std::vector<cv::Point2d> expected = project_by_opencv(camera(), points);
  ASSERT_EQ(expected.size(), points.size());
  ASSERT_GT(points.size(), 500U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 p(points[i].x, points[i].y, points[i].z);
    const Eigen::Vector2d pixel = project(camera(), p);
    // 1e-9 px in the image; rounding grows with the coordinate far outside.
    const double tolerance_px = 1e-9 * std::max(1.0, 1e-4 * pixel.norm());
    ASSERT_NEAR(pixel.x(), expected[i].x, tolerance_px) << p.transpose();
    ASSERT_NEAR(pixel.y(), expected[i].y, tolerance_px) << p.transpose();
  }
}

std::vector<CameraCase> folding_cases() {
  std::vector<CameraCase> cases;
  for (const CameraCase& one : camera_cases()) {
    if (!one.covers_image && one.camera.coefficients[2] == 0.0) cases.push_back(one);
  }
  return cases;
}

class FoldingCamera : public CameraModel {};
INSTANTIATE_TEST_SUITE_P(Every, FoldingCamera, testing::ValuesIn(folding_cases()),
                         [](const auto& one) { return one.param.name; });

TEST_P(FoldingCamera, HasRaysUpToTheFoldAndNoneBeyond) {
  for (double azimuth_rad = 0.0; azimuth_rad < 6.28; azimuth_rad += 0.1) {
    const Eigen::Vector2d principal(camera().cx, camera().cy);
    const Eigen::Vector2d fold = project(camera(), ray_at(domain_rad(), azimuth_rad));
    const auto at = [&](double share) -> Eigen::Vector2d {
      return principal + share * (fold - principal);
    };
    EXPECT_TRUE(unproject(camera(), at(0.9999)).has_value());
    EXPECT_FALSE(unproject(camera(), at(1.0001)).has_value());
    EXPECT_FALSE(unproject(camera(), at(2.0)).has_value());
  }
}

TEST_P(FoldingCamera, NeverReturnsToAPointBeyondTheFold) {
  for (const double beyond : {1.02, 1.1, 1.3}) {
    const Vector3 ray = ray_at(beyond * domain_rad(), 0.4);
    const auto back = unproject(camera(), project(camera(), ray));
    if (back) {
      EXPECT_GT((*back - ray).norm(), 1e-2);
    }
  }
}

}  // namespace
}  // namespace darkling::test
