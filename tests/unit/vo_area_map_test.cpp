// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "support/example_rigs.h"
#include "support/smooth_texture.h"
#include "vo/area_map.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;

struct RigCase {
  const char* name;
  StereoRig rig;
  int width_px;
};

std::vector<RigCase> rig_cases() {
  return {{"kitti_310", test::kitti_rig(), 310},        {"kitti_178", test::kitti_rig(), 178},
          {"kitti_1226", test::kitti_rig(), 1226},      {"euroc_376", test::euroc_rig(), 376},
          {"euroc_160", test::euroc_rig(), 160},        {"fisheye_128", test::fisheye_rig(), 128},
          {"upside_down", test::upside_down_rig(), 240}};
}

// The maps of both eyes, with their memory.
struct Maps {
  explicit Maps(const RigCase& rig_case)
      : rectified(*rectify_rig(rig_case.rig, rig_case.width_px)) {
    eyes[0] = {&rig_case.rig.left, rectified.R_rawleft_left, {}};
    eyes[1] = {&rig_case.rig.right, rectified.R_rawright_right, {}};
    for (Eye& eye : eyes) {
      eye.map = *fill_area_map(*eye.camera, rectified, eye.R_raw_rectified,
                               allocate_area_map(rectified, arena));
    }
  }
  // Where the thumbnail pixel's ray meets the raw image.
  [[nodiscard]] Eigen::Vector2d raw_pixel(int eye, int u, int v) const {
    const Vector3 ray = test::rectified_ray(rectified, u, v);
    return project(*eyes[eye].camera, eyes[eye].R_raw_rectified * ray);
  }

  struct Eye {
    const Camera* camera = nullptr;
    Matrix3 R_raw_rectified;
    AreaMap map;
  };
  RectifiedRig rectified;
  Arena arena{32u << 20};
  Eye eyes[2];
};

class EachRigsAreaMap : public ::testing::TestWithParam<RigCase> {
 protected:
  Maps maps_{GetParam()};
};

TEST_P(EachRigsAreaMap, StaysInsideTheRawImageWithEveryTap) {
  for (const Maps::Eye& eye : maps_.eyes) {
    ASSERT_TRUE(eye.map.entries.has_size(maps_.rectified.width, maps_.rectified.height));
    ASSERT_LE(eye.map.taps, kMaxAreaTaps);
    ASSERT_GE(eye.map.box_px, 1.0);
    for (int v = 0; v < eye.map.entries.height; ++v) {
      for (int u = 0; u < eye.map.entries.width; ++u) {
        const AreaMapEntry& e = eye.map.entries.at(u, v);
        ASSERT_LE(e.x + eye.map.taps, eye.camera->width) << u << " " << v;
        ASSERT_LE(e.y + eye.map.taps, eye.camera->height) << u << " " << v;
        ASSERT_LT(e.phase_x, kAreaPhases);
        ASSERT_LT(e.phase_y, kAreaPhases);
      }
    }
  }
}

TEST_P(EachRigsAreaMap, WeighsEveryPhaseThatItUsesToOne) {
  for (const Maps::Eye& eye : maps_.eyes) {
    for (int phase = 0; phase < kAreaPhases; ++phase) {
      int sum = 0;
      for (int i = 0; i < kMaxAreaTaps; ++i) {
        const int weight = eye.map.weights[phase * kMaxAreaTaps + i];
        ASSERT_TRUE(weight == 0 || i < eye.map.taps) << "phase " << phase << ", tap " << i;
        sum += weight;
      }
      ASSERT_EQ(sum, 256) << phase;
    }
  }
}

TEST_P(EachRigsAreaMap, IsTheMeanOverTheBoxAboutTheRaysPixel) {
  const test::SmoothTexture texture({.min_length = 80.0, .max_length = 400.0, .deviation = 35.0});
  for (int i = 0; i < 2; ++i) {
    const AreaMap& map = maps_.eyes[i].map;
    const Camera& camera = *maps_.eyes[i].camera;
    Arena arena(4u << 20);
    const auto raw = arena.allocate_image<std::uint8_t>(camera.width, camera.height, "raw");
    const auto thumbnail =
        arena.allocate_image<std::uint8_t>(map.entries.width, map.entries.height, "thumbnail");
    test::paint(raw, [&](int x, int y) { return texture.mean(x, y, 0.0); });
    remap_area_ref(map, raw, thumbnail);
    int compared = 0;
    for (int v = 0; v < thumbnail.height; ++v) {
      for (int u = 0; u < thumbnail.width; ++u) {
        const Eigen::Vector2d at = maps_.raw_pixel(i, u, v);
        const double reach = 0.5 * map.box_px - 0.5;  // nearer to the border the box is moved in
        if (at.x() < reach || at.y() < reach || at.x() > camera.width - 1 - reach ||
            at.y() > camera.height - 1 - reach) {
          continue;
        }
        ++compared;
        const double expected = texture.mean(at.x(), at.y(), map.box_px);
        if (expected < 0.5 || expected > 254.5) continue;  // does not fit a byte
        ASSERT_NEAR(thumbnail.at(u, v), expected, 1.0) << u << " " << v << " eye " << i;
      }
    }
    EXPECT_GT(compared, thumbnail.width * thumbnail.height * 9 / 10);
  }
}

INSTANTIATE_TEST_SUITE_P(Rigs, EachRigsAreaMap, ::testing::ValuesIn(rig_cases()),
                         [](const auto& tested) { return tested.param.name; });

// The largest swing about the mean that is left of stripes across the raw image.
double swing_left(const RigCase& rig_case, double wavelength_px) {
  const Maps maps(rig_case);
  const Camera& camera = rig_case.rig.left;
  Arena arena(4u << 20);
  const auto raw = arena.allocate_image<std::uint8_t>(camera.width, camera.height, "raw");
  const auto thumbnail =
      arena.allocate_image<std::uint8_t>(maps.rectified.width, maps.rectified.height, "thumbnail");
  test::paint(raw, [&](int x, int) {
    return 128.0 + 100.0 * std::cos(2.0 * std::numbers::pi * x / wavelength_px);
  });
  remap_area_ref(maps.eyes[0].map, raw, thumbnail);
  double swing = 0.0;
  for (int v = 0; v < thumbnail.height; ++v) {
    for (int u = 0; u < thumbnail.width; ++u) {
      swing = std::max(swing, std::abs(thumbnail.at(u, v) - 128.0));
    }
  }
  return swing;
}

TEST(AreaMap, SuppressesStripesThatTheThumbnailCannotShow) {
  const RigCase kitti{"", test::kitti_rig(), 178};
  const double box_px = Maps(kitti).eyes[0].map.box_px;
  EXPECT_NEAR(box_px, 1226.0 / 178.0, 0.01);
  // The sinc of a box: 0.13 of the swing is the highest beyond 1.4 wavelengths a box; point
  // sampling would leave it whole.
  EXPECT_LT(swing_left(kitti, box_px / 1.4), 24.0);
  EXPECT_LT(swing_left(kitti, 2.1), 24.0);
  EXPECT_LT(swing_left(kitti, box_px), 3.0);
  EXPECT_GT(swing_left(kitti, 6.0 * box_px), 80.0);  // and shows those that it can
}

TEST(AreaMap, RefusesAReductionBeyondItsTaps) {
  RectifiedRig rectified = *rectify_rig(test::kitti_rig(), 310);
  rectified.width = 30;
  rectified.height = 9;
  rectified.focal_px *= 30.0 / 310.0;
  Arena arena(1u << 20);
  const StereoRig rig = test::kitti_rig();
  const Result<AreaMap> map = fill_area_map(rig.left, rectified, rectified.R_rawleft_left,
                                            allocate_area_map(rectified, arena));
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(map.error().message, HasSubstr("to 30 px is above kMaxReduction = 31"));
}

}  // namespace
}  // namespace darkling
