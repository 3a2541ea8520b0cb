// SPDX-License-Identifier: Apache-2.0
// What can be put in place of bit-planes and semi-global matching, to compare with.
#include <cmath>

#include <gtest/gtest.h>

#include "kernels/bit_planes.h"
#include "support/kernel_cases.h"
#include "support/pixels.h"
#include "support/synthetic_run.h"
#include "vo/compare_intensity.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::GuardedImage;
using test::GuardedLayout;
using test::SyntheticRun;

// σ² = 2: a binomial filter of order 8 in both directions at once, from Pascal's triangle.
double smoothed_oracle(const ImageView<const std::uint8_t>& grey, int x, int y) {
  const auto choose = [](int k) {
    return std::tgamma(9.0) / (std::tgamma(1.0 + k) * std::tgamma(9.0 - k));
  };
  double sum = 0.0;
  for (int j = 0; j <= 8; ++j) {
    for (int i = 0; i <= 8; ++i) {
      const int u = std::clamp(x + i - 4, 0, grey.width - 1);
      const int v = std::clamp(y + j - 4, 0, grey.height - 1);
      sum += choose(i) * choose(j) * grey.at(u, v);
    }
  }
  return sum / 65536.0;
}

class IntensityPlanes : public ::testing::Test {
 protected:
  static constexpr int kWidth = 37;
  static constexpr int kHeight = 11;
  static constexpr GuardedLayout kLayout = {.width = kWidth, .height = kHeight, .row_padding = 3};
  static constexpr GuardedLayout kPlanesLayout = {
      .width = kWidth * kPlaneCount, .height = kHeight, .row_padding = 5};

  IntensityPlanes() { test::fill_image(grey_.view(), test::Fill::kUniform, 4); }

  GuardedImage<std::uint8_t> grey_{kLayout};
  GuardedImage<std::uint8_t> codes_{kLayout};
  GuardedImage<std::uint8_t> planes_{kPlanesLayout};
  alignas(64) std::array<std::uint8_t, bit_planes_scratch_bytes(kWidth)> scratch_;
};

TEST_F(IntensityPlanes, AreEightTimesTheSmoothedGreyLevel) {
  intensity_planes(grey_.view(), 0, codes_.view(), scratch_, planes_.view());
  for (int y = 0; y < kHeight; ++y) {
    for (int i = 0; i < kWidth * kPlaneCount; ++i) {
      const double expected = std::round(smoothed_oracle(grey_.view(), i / kPlaneCount, y));
      ASSERT_EQ(planes_.view().at(i, y), expected) << i << " " << y;
    }
  }
  EXPECT_TRUE(planes_.padding_is_untouched());
  EXPECT_TRUE(codes_.padding_is_untouched());
}

TEST_F(IntensityPlanes, KeepTheCensusCodes) {
  intensity_planes(grey_.view(), 0, codes_.view(), scratch_, planes_.view());
  GuardedImage<std::uint8_t> expected(kLayout);
  bit_planes_ref(grey_.view(), 0, expected.view(), scratch_, {});
  EXPECT_EQ(test::pixels_of(codes_.view()), test::pixels_of(expected.view()));
}

TEST_F(IntensityPlanes, AreGivenAloneWhenNoCodesAreAskedForAndTheOtherWayRound) {
  intensity_planes(grey_.view(), 0, codes_.view(), scratch_, planes_.view());
  GuardedImage<std::uint8_t> codes(kLayout);
  GuardedImage<std::uint8_t> planes(kPlanesLayout);
  intensity_planes(grey_.view(), 0, codes.view(), scratch_, {});
  intensity_planes(grey_.view(), 0, {}, scratch_, planes.view());
  EXPECT_EQ(test::pixels_of(codes.view()), test::pixels_of(codes_.view()));
  EXPECT_EQ(test::pixels_of(planes.view()), test::pixels_of(planes_.view()));
}

TEST_F(IntensityPlanes, KeepAConstantImage) {
  for (const unsigned level : {0u, 1u, 254u, 255u}) {
    test::fill_image(grey_.view(), test::Fill::kConstant, level);
    intensity_planes(grey_.view(), 0, {}, scratch_, planes_.view());
    const std::uint8_t shown = grey_.view().at(0, 0);
    EXPECT_EQ(test::pixels_of(planes_.view()),
              std::vector<std::uint8_t>(std::size_t{kWidth} * kPlaneCount * kHeight, shown));
  }
}

TEST(CompareIntensity, ReplacesWhatComparesAndLeavesTheRest) {
  const KernelTable kernels = test::available_tables().back();
  const KernelTable table = compare_intensity(kernels);
  EXPECT_EQ(table.bit_planes, intensity_planes);
  EXPECT_EQ(table.normal_equations, intensity_normal_equations);
  EXPECT_EQ(table.semi_global_row, kernels.semi_global_row);
  EXPECT_EQ(table.sample_residuals, kernels.sample_residuals);
}

// 20 frames of the corridor, 0.9 m.
struct Ride {
  double farthest_m = 0.0;  // from the truth
  Se3 T_world_body;
};
Ride ride_corridor(const OdometryConfig& config) {
  const SyntheticRun& run = test::synthetic_run("corridor,frames=20,width=160,seed=2");
  const auto odometry =
      Odometry::create(config, run.rig, KernelTable(), [] { return MonotonicTime(); });
  Ride ride;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const Estimate estimate = (*odometry)->track(run.frames[i].at(static_cast<std::int64_t>(i)));
    EXPECT_NE(estimate.status, TrackStatus::kLost) << i;
    ride.T_world_body = estimate.T_world_body;
    const double error_m =
        (estimate.T_world_body.translation() - run.T_world_body[i].translation()).norm();
    ride.farthest_m = std::max(ride.farthest_m, error_m);
  }
  return ride;
}

TEST(Ablations, FollowALitCorridor) {
  const auto farthest_m = [](const OdometryConfig& config) {
    return ride_corridor(config).farthest_m;
  };
  EXPECT_LT(farthest_m({.width_px = 160, .descriptor = Descriptor::kIntensity}), 0.06);
  EXPECT_LT(farthest_m({.width_px = 160, .stereo = StereoMethod::kBlock}), 0.02);
}

TEST(Ablations, AreInUse) {
  const auto pose = [](const OdometryConfig& config) {
    return ride_corridor(config).T_world_body.matrix();
  };
  const Eigen::Matrix4d usual = pose({.width_px = 160});
  EXPECT_NE(pose({.width_px = 160, .descriptor = Descriptor::kIntensity}), usual);
  EXPECT_NE(pose({.width_px = 160, .stereo = StereoMethod::kBlock}), usual);
}

}  // namespace
}  // namespace darkling
