// SPDX-License-Identifier: Apache-2.0
#include <cmath>

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
  const FramePyramid pyramid = allocate_pyramid(rig, {3, 2, 1}, arena);
  ASSERT_EQ(pyramid.size(), 3u);
  for (int l = 0; l < 3; ++l) {
    const double factor = 1 << l;
    EXPECT_EQ(pyramid[l].grey.width, 160 >> l);
    EXPECT_EQ(pyramid[l].grey.height, 120 >> l);
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

TEST(FramePyramid, HasPlanesAndCodesOnlyWhereTheLayoutWantsThem) {
  Arena arena(4u << 20);
  const FramePyramid pyramid = allocate_pyramid(test::ideal_rig(), {3, 2, 1}, arena);
  for (int l = 0; l < 3; ++l) {
    EXPECT_EQ(pyramid[l].planes.is_empty(), l == 2) << l;
    EXPECT_EQ(pyramid[l].codes.is_empty(), l == 2) << l;
    if (l == 2) continue;
    EXPECT_TRUE(pyramid[l].planes.has_size((160 >> l) * kPlaneCount, 120 >> l));
    EXPECT_TRUE(pyramid[l].codes.has_size(160 >> l, 120 >> l));
  }
  const FramePyramid other = allocate_pyramid(test::ideal_rig(), {3, 1, 2}, arena);
  EXPECT_FALSE(other[0].codes.is_empty());
  EXPECT_TRUE(other[1].codes.is_empty());
  EXPECT_FALSE(other[2].codes.is_empty());
  EXPECT_TRUE(other[2].planes.is_empty());
}

std::vector<std::uint8_t> codes_of(test::EyeStages& eye) {
  eye.prepare(KernelTable());
  return test::pixels_of(eye.codes());
}

TEST(CodesOfAnImage, ChangeWhenAGreyMapTurnsTheOrderRoundAndNotWhenAllIsBrighter) {
  test::EyeStages eye(test::ideal_rig(), 1);
  const ImageView<std::uint8_t> image = eye.grey();
  const auto change_all = [&image](const auto& change) {
    for (int i = 0; i < image.width * image.height; ++i) {
      std::uint8_t& level = image.at(i % image.width, i / image.width);
      level = static_cast<std::uint8_t>(change(level));
    }
  };
  test::fill_image(image, test::Fill::kUniform, 5);
  change_all([](int level) { return level / 2; });
  const std::vector<std::uint8_t> before = codes_of(eye);
  change_all([](int level) { return level + 100; });
  EXPECT_EQ(codes_of(eye), before);
  change_all([](int level) { return 255 - level; });
  EXPECT_NE(codes_of(eye), before);
}

TEST(ComputePlanes, FillEveryLevelFromItsOwnGreyImage) {
  const RectifiedRig rig = test::ideal_rig();
  test::EyeStages eye(rig, 3, 1);
  test::fill_image(eye.grey(), test::Fill::kUniform, 9);
  eye.prepare(KernelTable());
  Arena arena(4u << 20);
  const auto scratch = allocate_plane_scratch(rig, arena);
  for (int l = 0; l < 3; ++l) {
    const PyramidLevel& level = eye.pyramid()[l];
    const auto codes =
        arena.allocate_image<std::uint8_t>(level.grey.width, level.grey.height, "codes");
    const auto planes =
        arena.allocate_image<std::uint8_t>(level.planes.width, level.planes.height, "planes");
    bit_planes_ref(level.grey, level.dead_zone, codes, scratch, planes);
    EXPECT_EQ(test::pixels_of(level.planes), test::pixels_of(planes)) << l;
    EXPECT_TRUE(l == 2 || test::pixels_of(level.codes) == test::pixels_of(codes)) << l;
  }
}

TEST(ComputePlanes, LeaveALevelAloneThatHasNeitherPlanesNorCodes) {
  const RectifiedRig rig = test::ideal_rig();
  Arena arena(4u << 20);
  FramePyramid pyramid = allocate_pyramid(rig, {3, 1, 0}, arena);
  const auto scratch = allocate_plane_scratch(rig, arena);
  test::fill_image(pyramid[2].grey, test::Fill::kUniform, 9);
  const std::vector<std::uint8_t> before = test::pixels_of(pyramid[2].grey);
  compute_planes(KernelTable(), scratch, pyramid[2]);
  EXPECT_EQ(test::pixels_of(pyramid[2].grey), before);
}

}  // namespace
}  // namespace darkling
