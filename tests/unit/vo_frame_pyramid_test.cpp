// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>

#include "geometry/frames.h"
#include "support/kernel_cases.h"
#include "support/pixels.h"
#include "support/vo_stages.h"
#include "vo/frame_pyramid.h"

namespace darkling {
namespace {

TEST(PyramidLevelCount, EndsNearestToFortyPixels) {
  EXPECT_EQ(pyramid_level_count(310, 94), 4);
  EXPECT_EQ(pyramid_level_count(376, 240), 4);
  EXPECT_EQ(pyramid_level_count(160, 102), 3);
  EXPECT_EQ(pyramid_level_count(320, 240), 4);
  EXPECT_EQ(pyramid_level_count(56, 40), 1);
  EXPECT_EQ(pyramid_level_count(57, 40), 2);
  EXPECT_EQ(pyramid_level_count(40, 30), 1);
}

TEST(PyramidLevelCount, KeepsTenRowsOnTheCoarsestLevel) {
  EXPECT_EQ(pyramid_level_count(310, 79), 3);
  EXPECT_EQ(pyramid_level_count(310, 80), 4);
  EXPECT_EQ(pyramid_level_count(1280, 24), 2);
}

TEST(PyramidLevelCount, NeverExceedsTheLimit) {
  for (int width = 1; width <= 20000; width += 7) {
    EXPECT_LE(pyramid_level_count(width, width), kMaxLevels);
    EXPECT_GE(pyramid_level_count(width, 1), 1);
  }
}

TEST(FramePyramid, HalvesTheCameraWithTheHalfPixelShift) {
  RectifiedRig rig = test::ideal_rig();
  rig.cx = 80.25;
  Arena arena(4u << 20);
  const FramePyramid pyramid = allocate_pyramid(rig, 3, arena);
  ASSERT_EQ(pyramid.size(), 3u);
  for (int l = 0; l < 3; ++l) {
    const double factor = 1 << l;
    EXPECT_EQ(pyramid[l].grey.width, 160 >> l);
    EXPECT_EQ(pyramid[l].grey.height, 120 >> l);
    EXPECT_EQ(pyramid[l].planes.width, (160 >> l) * kPlaneCount);
    EXPECT_DOUBLE_EQ(pyramid[l].focal_px, rig.focal_px / factor);
    EXPECT_DOUBLE_EQ(pyramid[l].cx, reduce_pixel(rig.cx, factor));
    EXPECT_DOUBLE_EQ(pyramid[l].cy, reduce_pixel(rig.cy, factor));
  }
}

// A wide blob stays where its camera coordinates say on every level.
TEST(FramePyramid, KeepsABlobOnItsRayOnEveryLevel) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages eye(rig, 3);
  constexpr double kBlobX = 61.3;
  constexpr double kBlobY = 47.9;
  test::paint(eye.grey(), [](int x, int y) {
    const double r2 = (x - kBlobX) * (x - kBlobX) + (y - kBlobY) * (y - kBlobY);
    return 255.0 * std::exp(-0.5 * r2 / 64.0);
  });
  eye.prepare(KernelTable());
  for (const PyramidLevel& level : eye.pyramid()) {
    double sum = 0.0;
    double sum_x = 0.0;
    for (int y = 0; y < level.grey.height; ++y) {
      for (int x = 0; x < level.grey.width; ++x) {
        sum += level.grey.at(x, y);
        sum_x += level.grey.at(x, y) * double(x);
      }
    }
    const double ray_x = (sum_x / sum - level.cx) / level.focal_px;
    EXPECT_NEAR(ray_x, (kBlobX - rig.cx) / rig.focal_px, 0.05 / rig.focal_px);
  }
}

// `levels` different grey levels out of 256, in order.
std::vector<std::uint8_t> random_increasing_map(int levels, std::mt19937& random) {
  std::vector<std::uint8_t> map(256);
  std::iota(map.begin(), map.end(), std::uint8_t{0});
  std::shuffle(map.begin(), map.end(), random);
  map.resize(static_cast<std::size_t>(levels));
  std::sort(map.begin(), map.end());
  return map;
}

TEST(BitPlanesOfAnImage, IgnoreEveryStrictlyIncreasingGreyMapWhenNothingIsSmoothed) {
  constexpr int kLevels = 90;
  std::mt19937 random(3);
  Arena arena(4u << 20);
  const auto plain = arena.allocate_image<std::uint8_t>(53, 41, "plain");
  const auto mapped = arena.allocate_image<std::uint8_t>(53, 41, "mapped");
  const auto codes = arena.allocate_image<std::uint8_t>(53, 41, "codes");
  const auto planes = arena.allocate_image<std::uint8_t>(53 * kPlaneCount, 41, "planes");
  const auto row = arena.allocate<std::uint8_t>((53 + 8) * kPlaneCount, "row");
  for (const KernelTable& kernels : test::available_tables()) {
    const auto planes_of = [&](const ImageView<const std::uint8_t>& image) {
      kernels.census(image, codes);
      kernels.bit_planes(codes, make_smoothing_taps(0.0), row.data(), planes);
      return test::pixels_of(planes);
    };
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<std::uint8_t> map = random_increasing_map(kLevels, random);
      for (int i = 0; i < 53 * 41; ++i) {
        plain.at(i % 53, i / 53) = static_cast<std::uint8_t>(random() % kLevels);
        mapped.at(i % 53, i / 53) = map[plain.at(i % 53, i / 53)];
      }
      ASSERT_EQ(planes_of(plain), planes_of(mapped)) << kernels.name;
    }
  }
}

TEST(BitPlanesOfAnImage, ChangeWhenAGreyMapTurnsTheOrderRound) {
  Arena arena(1u << 20);
  const auto image = arena.allocate_image<std::uint8_t>(20, 20, "image");
  const auto codes = arena.allocate_image<std::uint8_t>(20, 20, "codes");
  test::fill_image(image, test::Fill::kUniform, 5);
  census_ref(image, codes);
  const std::vector<std::uint8_t> before = test::pixels_of(codes);
  for (int i = 0; i < 400; ++i) image.at(i % 20, i / 20) = 255 - image.at(i % 20, i / 20);
  census_ref(image, codes);
  EXPECT_NE(test::pixels_of(codes), before);
}

TEST(ComputePlanes, AreTheSmoothedCensusOfTheBlurredImage) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages eye(rig, 1);
  test::fill_image(eye.grey(), test::Fill::kUniform, 9);
  eye.prepare(KernelTable());
  Arena arena(4u << 20);
  const auto blurred = arena.allocate_image<std::uint8_t>(rig.width, rig.height, "blurred");
  const auto codes = arena.allocate_image<std::uint8_t>(rig.width, rig.height, "codes");
  const auto planes =
      arena.allocate_image<std::uint8_t>(rig.width * kPlaneCount, rig.height, "planes");
  const auto row = arena.allocate<std::uint8_t>((rig.width + 8) * kPlaneCount, "row");
  blur3_ref(eye.grey(), blurred);
  census_ref(blurred, codes);
  bit_planes_ref(codes, make_smoothing_taps(kPlaneSigmaPx), row.data(), planes);
  EXPECT_EQ(test::pixels_of(eye.codes()), test::pixels_of(codes));
  EXPECT_EQ(test::pixels_of(eye.pyramid()[0].planes), test::pixels_of(planes));
}

}  // namespace
}  // namespace darkling
