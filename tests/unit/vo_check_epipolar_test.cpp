// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "drivers/synthetic/synthetic_source.h"
#include "vo/check_epipolar.h"

namespace darkling::test {
namespace {

// What is found in a few frames of a scene when `change` is what the calibration has wrong.
template <class Change>
EpipolarReport report_of(const std::string& text, Change change) {
  const auto spec = parse_synthetic(text);
  EXPECT_TRUE(spec) << spec.error().message;
  const auto source = SyntheticSource::create(*spec);
  EXPECT_TRUE(source) << source.error().message;
  StereoRig rig = (*source)->rig();
  change(rig);
  const auto check = EpipolarCheck::create(rig, 320, KernelTable());
  EXPECT_TRUE(check) << check.error().message;
  EXPECT_TRUE((*source)->start());
  for (int i = 0; i < spec->frames; ++i) {
    const WaitResult result = (*source)->wait_next(std::chrono::seconds(10));
    EXPECT_EQ(result.status, WaitStatus::kFrame);
    if (result.status == WaitStatus::kFrame) (*check)->add(result.lease.frame());
  }
  (*source)->stop();
  return (*check)->report();
}

void turn_right_camera(StereoRig& rig, const Vector3& degrees) {
  rig.T_body_rawright =
      rig.T_body_rawright * Se3(so3_exp(degrees * std::numbers::pi / 180.0), Vector3::Zero());
}

constexpr const char* kScenes[] = {"mine", "quarry", "corridor"};

TEST(CheckEpipolar, FindsMatchingRowsWhereTheCalibrationIsTheCameras) {
  for (const char* scene : kScenes) {
    const auto report =
        report_of("synthetic:" + std::string(scene) + ",frames=3,width=320", [](StereoRig&) {});
    EXPECT_GT(report.matches, 2 * kFewestEpipolarMatches) << scene;
    EXPECT_LT(report.median_abs_px, 0.25) << scene;
    EXPECT_NEAR(report.median_px, 0.0, 0.15) << scene;
    EXPECT_NEAR(report.roll_deg, 0.0, 0.1) << scene;
    EXPECT_NEAR(report.scale, 1.0, 0.002) << scene;
  }
}

TEST(CheckEpipolar, FindsMatchingRowsOfCamerasThatAreTurnedAndKnownToBe) {
  const auto report = report_of("synthetic:mine,frames=3,width=320,distortion=1,roll_right_deg=2",
                                [](StereoRig&) {});
  EXPECT_GT(report.matches, 2 * kFewestEpipolarMatches);
  EXPECT_LT(report.median_abs_px, 0.3);
}

TEST(CheckEpipolar, FindsTheRollThatACalibrationDoesNotKnow) {
  for (const double roll_deg : {-2.0, 2.0}) {
    const auto report = report_of("synthetic:mine,frames=3,width=320", [roll_deg](StereoRig& rig) {
      turn_right_camera(rig, {0, 0, roll_deg});
    });
    EXPECT_GT(report.matches, kFewestEpipolarMatches);
    EXPECT_GT(report.median_abs_px, kMostEpipolarOffset_px);
    EXPECT_NEAR(std::abs(report.roll_deg), 2.0, 0.3);
    EXPECT_EQ(std::signbit(report.roll_deg), std::signbit(roll_deg));
  }
}

TEST(CheckEpipolar, FindsCamerasThatLookUpOrDown) {
  // Half a degree is 2 to 3 px at 320 px; rectification shares it between the eyes.
  const auto report = report_of("synthetic:quarry,frames=3,width=320", [](StereoRig& rig) {
    turn_right_camera(rig, {0.5, 0, 0});
  });
  EXPECT_GT(report.matches, kFewestEpipolarMatches);
  EXPECT_GT(report.median_abs_px, kMostEpipolarOffset_px);
  EXPECT_LT(std::abs(report.roll_deg), 0.3);
}

TEST(CheckEpipolar, FindsFocalLengthsThatAreNotTheCameras) {
  const auto report = report_of("synthetic:quarry,frames=3,width=320", [](StereoRig& rig) {
    rig.right.fx *= 0.97;
    rig.right.fy *= 0.97;
  });
  EXPECT_GT(report.matches, kFewestEpipolarMatches);
  EXPECT_NEAR(report.scale, 1.03, 0.005);
}

TEST(CheckEpipolar, SaysNothingOfNothing) {
  const auto spec = parse_synthetic("synthetic:mine,frames=1,width=320");
  const auto source = SyntheticSource::create(*spec);
  const auto check = EpipolarCheck::create((*source)->rig(), 320, KernelTable());
  ASSERT_TRUE(check);
  const std::vector<std::uint8_t> black(320 * 240);
  const ImageView<const std::uint8_t> view(black.data(), 320, 240, 320);
  (*check)->add({.sequence = 0, .stamp = {}, .left = view, .right = view});
  EXPECT_EQ((*check)->report().corners, 0);
  EXPECT_EQ((*check)->report().matches, 0);
}

TEST(CheckEpipolar, RefusesARigThatMakesNoSense) {
  EXPECT_FALSE(EpipolarCheck::create(StereoRig(), 320, KernelTable()));
}

}  // namespace
}  // namespace darkling::test
