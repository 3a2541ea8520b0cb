// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/stereo_rig.h"
#include "support/example_rigs.h"

namespace darkling::test {
namespace {

using testing::HasSubstr;

constexpr double kRadians = std::numbers::pi / 180.0;

// The message the rig is refused with; empty when it is accepted.
std::string refusal(const StereoRig& rig) {
  const Result<void> result = check_rig(rig);
  if (result) return "";
  EXPECT_EQ(result.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(result.error().message, HasSubstr("allowed: "));
  return result.error().message;
}

// EuRoC's cameras with the right one at `T_rawleft_rawright`.
StereoRig rig_with(const Se3& T_rawleft_rawright) {
  StereoRig rig = euroc_rig();
  rig.T_body_rawright = rig.T_body_rawleft * T_rawleft_rawright;
  return rig;
}

StereoRig rig_with_baseline(const Vector3& t) {
  return rig_with(Se3(Matrix3(Matrix3::Identity()), t));
}

StereoRig rig_turned_by(const Vector3& theta_deg) {
  return rig_with(Se3(so3_exp(kRadians * theta_deg), Vector3(0.11, 0.0, 0.0)));
}

TEST(CheckRig, AcceptsRealRigs) {
  EXPECT_EQ(refusal(euroc_rig()), "");
  EXPECT_EQ(refusal(kitti_rig()), "");
  EXPECT_EQ(refusal(fisheye_rig()), "");
  EXPECT_EQ(refusal(toed_in_rig()), "");
}

TEST(CheckRig, AcceptsAPairMountedUpsideDown) {
  EXPECT_EQ(refusal(upside_down_rig()), "");
}

TEST(CheckRig, RefusesImagesOfDifferentSizes) {
  StereoRig rig = euroc_rig();
  rig.right.height = 400;
  EXPECT_THAT(refusal(rig), HasSubstr("left images are 752x480 px, the right ones 752x400 px"));
}

TEST(CheckRig, RefusesAbsurdSizesAndNamesTheCamera) {
  StereoRig rig = euroc_rig();
  rig.right.width = 0;
  EXPECT_THAT(refusal(rig), HasSubstr("right camera: image size 0x480 px"));
  rig = euroc_rig();
  rig.left.height = 100'000;
  EXPECT_THAT(refusal(rig), HasSubstr("left camera: image size 752x100000 px"));
}

TEST(CheckRig, RefusesFocalLengthsThatNoLensHas) {
  for (const double focal_px : {0.0, -458.0, 0.458, 458'654.0}) {
    StereoRig rig = euroc_rig();
    rig.left.fx = rig.left.fy = focal_px;
    EXPECT_THAT(refusal(rig), HasSubstr("left camera: focal lengths")) << focal_px;
    rig = euroc_rig();
    rig.right.fy = focal_px;
    EXPECT_THAT(refusal(rig), HasSubstr("right camera: focal lengths")) << focal_px;
  }
}

TEST(CheckRig, RefusesFocalLengthsThatDoNotGoTogether) {
  StereoRig rig = euroc_rig();
  rig.left.fy = 150.0;
  EXPECT_THAT(refusal(rig), HasSubstr("458.654 and 150 px"));
}

TEST(CheckRig, RefusesPrincipalPointsFarOutsideTheImage) {
  StereoRig rig = euroc_rig();
  rig.left.cx = 3000.0;
  EXPECT_THAT(refusal(rig), HasSubstr("left camera: principal point (3000, 248.375) px"));
  rig = euroc_rig();
  rig.right.cy = -400.0;
  EXPECT_THAT(refusal(rig), HasSubstr("right camera: principal point"));
}

TEST(CheckRig, RefusesNumbersThatAreNotFinite) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  StereoRig rig = euroc_rig();
  rig.left.fx = kNone;
  EXPECT_THAT(refusal(rig), HasSubstr("left camera"));
  rig = euroc_rig();
  rig.right.coefficients[3] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(rig), HasSubstr("right camera"));
  EXPECT_THAT(refusal(rig_with_baseline({kNone, 0.0, 0.0})), HasSubstr("right camera: its pose"));
  rig = euroc_rig();
  rig.T_body_rawleft = Se3(Eigen::Quaterniond(0.0, 0.0, 0.0, 0.0), Vector3::Zero());
  EXPECT_THAT(refusal(rig), HasSubstr("left camera: its pose"));
}

TEST(CheckRig, NamesSwappedEyes) {
  StereoRig rig = euroc_rig();
  std::swap(rig.T_body_rawleft, rig.T_body_rawright);
  EXPECT_THAT(refusal(rig), HasSubstr("the eyes look swapped"));
  EXPECT_THAT(refusal(rig), HasSubstr("-0.11"));
}

TEST(CheckRig, RefusesBaselinesThatAreZeroOrAbsurd) {
  EXPECT_THAT(refusal(rig_with_baseline({0.0, 0.0, 0.0})), HasSubstr("baseline of 0 m"));
  EXPECT_THAT(refusal(rig_with_baseline({0.004, 0.0, 0.0})), HasSubstr("baseline of 0.004 m"));
  // Millimetres taken for metres.
  EXPECT_THAT(refusal(rig_with_baseline({110.0, 0.0, 0.0})), HasSubstr("baseline of 110 m"));
  EXPECT_THAT(refusal(rig_with_baseline({110.0, 0.0, 0.0})),
              HasSubstr("in mm, the baseline would be 0.11 m"));
  EXPECT_THAT(refusal(rig_with_baseline({1e300, 0.0, 0.0})), HasSubstr("in metres?"));
  EXPECT_THAT(refusal(rig_with_baseline({1e308, -1e308, 1e308})), HasSubstr("allowed: "));
}

TEST(CheckRig, AcceptsBaselinesAtBothBounds) {
  EXPECT_EQ(refusal(rig_with_baseline({0.00501, 0.0, 0.0})), "");
  EXPECT_EQ(refusal(rig_with_baseline({4.999, 0.0, 0.0})), "");
}

TEST(CheckRig, NamesCamerasOneAboveOrBehindTheOther) {
  EXPECT_THAT(refusal(rig_with_baseline({0.01, 0.11, 0.0})), HasSubstr("one above the other"));
  EXPECT_THAT(refusal(rig_with_baseline({0.01, -0.11, 0.0})), HasSubstr("one above the other"));
  EXPECT_THAT(refusal(rig_with_baseline({0.01, 0.0, 0.11})), HasSubstr("one behind the other"));
}

TEST(CheckRig, RefusesABaselineFarOffTheRows) {
  EXPECT_THAT(refusal(rig_with_baseline({0.11, 0.08, 0.0})), HasSubstr("36.0274° off"));
  EXPECT_EQ(refusal(rig_with_baseline({0.11, 0.05, 0.0})), "");
}

// With the cameras rolled 28° against each other, the rows are taken half-way, at 14°.
TEST(CheckRig, MeasuresTheSlantHalfWayBetweenTheCameras) {
  const auto slanted_by = [](double slant_deg) {
    const double slant = kRadians * slant_deg;
    return rig_with(Se3(so3_exp(Vector3(0.0, 0.0, 28.0 * kRadians)),
                        0.11 * Vector3(std::cos(slant), std::sin(slant), 0.0)));
  };
  EXPECT_EQ(refusal(slanted_by(20.0)), "");
  EXPECT_THAT(refusal(slanted_by(-20.0)), HasSubstr("the baseline is 34° off"));
}

TEST(CheckRig, RefusesCamerasTurnedFarAgainstEachOther) {
  EXPECT_EQ(refusal(rig_turned_by({0.0, 29.0, 0.0})), "");
  EXPECT_THAT(refusal(rig_turned_by({0.0, 31.0, 0.0})), HasSubstr("turned 31° against"));
  EXPECT_THAT(refusal(rig_turned_by({0.0, 0.0, 180.0})), HasSubstr("turned 180° against"));
}

}  // namespace
}  // namespace darkling::test
