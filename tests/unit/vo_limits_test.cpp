// SPDX-License-Identifier: Apache-2.0
// Both sides of every limit, and the whole odometry at sizes that are multiples of nothing.
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "support/kernel_cases.h"
#include "support/synthetic_run.h"
#include "vo/check_limits.h"
#include "vo/frame_pyramid.h"
#include "vo/limits.h"
#include "vo/match_stereo.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::KeptFrame;
using test::SyntheticRun;
using ::testing::HasSubstr;

constexpr char kCorridor[] = "corridor,frames=12,width=160,seed=2";

MonotonicTime stopped_clock() {
  return MonotonicTime();
}

// A rig like the corridor's, but with images of another size.
StereoRig rig_of_size(int width_px, int height_px) {
  StereoRig rig = test::synthetic_run(kCorridor).rig;
  for (Camera* camera : {&rig.left, &rig.right}) {
    const double factor = static_cast<double>(width_px) / camera->width;
    camera->width = width_px;
    camera->height = height_px;
    camera->fx *= factor;
    camera->fy *= factor;
    camera->cx = 0.5 * width_px - 0.5;
    camera->cy = 0.5 * height_px - 0.5;
  }
  return rig;
}

Result<std::unique_ptr<Odometry>> create(const OdometryConfig& config, const StereoRig& rig) {
  return Odometry::create(config, rig, KernelTable(), stopped_clock);
}

std::string refusal(const OdometryConfig& config, const StereoRig& rig) {
  const auto odometry = create(config, rig);
  if (odometry) return "accepted";
  EXPECT_EQ(odometry.error().code, ExitCode::kConfiguration);
  return odometry.error().message;
}

std::string refusal(int width_px, int height_px, int points = 1000) {
  const auto checked = check_limits({.points_per_level = points}, width_px, height_px);
  return checked ? "accepted" : checked.error().message;
}

TEST(Limits, HoldOnBothSides) {
  EXPECT_EQ(refusal(kMinWidth, kMinHeight, kMinPointsPerLevel), "accepted");
  EXPECT_EQ(refusal(kMaxWidth, kMaxHeight, kMaxPointsPerLevel), "accepted");
  EXPECT_EQ(refusal(63, 48), "thumbnail width 63 px is below kMinWidth = 64");
  EXPECT_EQ(refusal(1281, 960), "thumbnail width 1281 px is above kMaxWidth = 1280");
  EXPECT_THAT(refusal(200, 23), HasSubstr(" 23 px is below kMinHeight = 24"));
  EXPECT_THAT(refusal(1200, 1025), HasSubstr(" 1025 px is above kMaxHeight = 1024"));
  EXPECT_EQ(refusal(320, 240, 99), "points_per_level 99 is below kMinPointsPerLevel = 100");
  EXPECT_EQ(refusal(320, 240, 4001), "points_per_level 4001 is above kMaxPointsPerLevel = 4000");
}

TEST(OdometryCreate, RefusesAThumbnailOutsideTheLimitsByName) {
  const StereoRig large = rig_of_size(1400, 1050);
  EXPECT_EQ(refusal({.width_px = 1400}, large),
            "thumbnail width 1400 px is above kMaxWidth = 1280");
  EXPECT_EQ(refusal({.width_px = 0}, large), "thumbnail width 1400 px is above kMaxWidth = 1280");
  EXPECT_EQ(refusal({.width_px = 1280}, large), "accepted");
  EXPECT_EQ(refusal({.width_px = 10}, large), "thumbnail width 10 px is below kMinWidth = 64");
  EXPECT_THAT(refusal({.width_px = 320, .points_per_level = 10}, large),
              HasSubstr("kMinPointsPerLevel"));
}

TEST(OdometryCreate, RefusesASourceWhoseAspectMakesTheThumbnailTooLow) {
  const StereoRig strip = rig_of_size(1280, 256);  // 5 : 1
  EXPECT_THAT(refusal({.width_px = 64}, strip),
              HasSubstr("from a width of 64 px, 13 px is below kMinHeight = 24"));
  EXPECT_THAT(refusal({.width_px = 117}, strip), HasSubstr("23 px is below kMinHeight = 24"));
  EXPECT_EQ(refusal({.width_px = 118}, strip), "accepted");
}

TEST(OdometryCreate, RefusesASourceWhoseAspectMakesTheThumbnailTooHigh) {
  const StereoRig upright = rig_of_size(800, 1600);
  EXPECT_EQ(refusal({.width_px = 512}, upright), "accepted");
  EXPECT_THAT(refusal({.width_px = 513}, upright), HasSubstr("1026 px is above kMaxHeight = 1024"));
}

TEST(OdometryCreate, RefusesAReductionBeyondTheLimit) {
  EXPECT_EQ(refusal({.width_px = 64}, rig_of_size(64 * 31, 48 * 31)), "accepted");
  EXPECT_THAT(refusal({.width_px = 64}, rig_of_size(64 * 32, 48 * 32)),
              HasSubstr("a reduction of 32 from 2048 to 64 px is above kMaxReduction = 31"));
}

TEST(OdometryCreate, TakesTheSmallestSourceThereIs) {
  EXPECT_EQ(refusal({.width_px = 64}, rig_of_size(64, 32)), "accepted");
  EXPECT_THAT(refusal({.width_px = 64}, rig_of_size(64, 24)), HasSubstr("image size 64x24"));
}

TEST(Limits, AreEnoughForWhatFollowsFromTheWidth) {
  for (int width_px = kMinWidth; width_px <= kMaxWidth; ++width_px) {
    const int levels = pyramid_level_count(width_px, kMaxHeight);
    ASSERT_LE(levels, kMaxLevels) << width_px;
    ASSERT_LE(width_px >> stereo_level(width_px, levels), kMaxStereoWidth) << width_px;
  }
  EXPECT_GE(kDisparities, kMaxStereoWidth / 6);
}

TEST(OdometryCreate, FitsItsArenaAtEverySize) {
  const StereoRig large = rig_of_size(1280, 960);
  for (const int points : {kMinPointsPerLevel, kMaxPointsPerLevel}) {
    for (const int width_px : {64, 65, 97, 320, 333, 640, 1279, 0}) {
      const auto odometry = create({.width_px = width_px, .points_per_level = points}, large);
      ASSERT_TRUE(odometry) << odometry.error().message;
      const RectifiedRig& rig = (*odometry)->rig();
      EXPECT_GT((*odometry)->arena_bytes(), 0u);
      EXPECT_LT((*odometry)->arena_bytes(), memory_budget_bytes(rig.width, rig.height));
    }
  }
}

struct OddSize {
  const char* scene;
  int width_px;
  int points_per_level;
  int enlargement = 1;  // of the rendered images
};

void PrintTo(const OddSize& size, std::ostream* out) {
  *out << size.scene << " at " << size.width_px << " px, " << size.points_per_level << " points";
}

// Every pixel k × k times: large images take long to render.
std::vector<std::uint8_t> enlarge(const std::vector<std::uint8_t>& pixels, int width, int k) {
  std::vector<std::uint8_t> large;
  const int height = static_cast<int>(pixels.size()) / width;
  for (int v = 0; v < height * k; ++v) {
    for (int u = 0; u < width * k; ++u) large.push_back(pixels[v / k * width + u / k]);
  }
  return large;
}

KeptFrame enlarge(const KeptFrame& frame, int k) {
  return {frame.width * k, frame.height * k, enlarge(frame.left, frame.width, k),
          enlarge(frame.right, frame.width, k)};
}

StereoRig enlarge(StereoRig rig, int k) {
  for (Camera* camera : {&rig.left, &rig.right}) {
    camera->width *= k;
    camera->height *= k;
    camera->fx *= k;
    camera->fy *= k;
    camera->cx = (camera->cx + 0.5) * k - 0.5;
    camera->cy = (camera->cy + 0.5) * k - 0.5;
  }
  return rig;
}

class EachOddSize : public ::testing::TestWithParam<OddSize> {};

bool is_finite(const Estimate& e) {
  return e.T_world_left.matrix().allFinite() && e.T_world_body.matrix().allFinite() &&
         e.T_previous_body.matrix().allFinite() && std::isfinite(e.cost) &&
         std::isfinite(e.visible_fraction);
}

TEST_P(EachOddSize, IsTrackedWithoutFaults) {
  const SyntheticRun& run = test::synthetic_run(GetParam().scene);
  const int k = GetParam().enlargement;
  std::vector<KernelTable> tables = test::available_tables();
  // At full width the references take minutes under sanitizers.
  if (GetParam().width_px == kMaxWidth) tables.erase(tables.begin(), tables.end() - 1);
  for (const KernelTable& kernels : tables) {
    const auto odometry = Odometry::create(
        {.width_px = GetParam().width_px, .points_per_level = GetParam().points_per_level},
        enlarge(run.rig, k), kernels, stopped_clock);
    ASSERT_TRUE(odometry) << odometry.error().message;
    int keyframes = 0;
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const Estimate estimate =
          (*odometry)->track(enlarge(run.frames[i], k).at(static_cast<int>(i)));
      ASSERT_TRUE(is_finite(estimate)) << kernels.name << " " << i;
      keyframes += estimate.is_keyframe ? 1 : 0;
    }
    EXPECT_GE(keyframes, 1) << kernels.name;
    const Estimate noisy =
        (*odometry)->track(test::noise_frame(enlarge(run.frames[0], k), 1).at(90));
    EXPECT_TRUE(is_finite(noisy)) << kernels.name;
  }
}

// 64x24 is the smallest thumbnail; the last two come from images of 1920x1080 px.
INSTANTIATE_TEST_SUITE_P(
    Odometry, EachOddSize,
    ::testing::Values(OddSize{"corridor,frames=4,width=192,height=72", 64, kMinPointsPerLevel},
                      OddSize{"corridor,frames=4,width=192,height=72", 64, kMaxPointsPerLevel},
                      OddSize{"corridor,frames=4,width=64,height=48", 64, 1000},
                      OddSize{"corridor,frames=4,width=64,height=96", 0, 1000},
                      OddSize{"corridor,frames=4,width=65,height=49", 65, 1000},
                      OddSize{"corridor,frames=4,width=97,height=71", 0, 1000},
                      OddSize{"mine,frames=4,width=333,height=251,distortion=1", 65, 1000},
                      OddSize{"mine,frames=4,width=333,height=251,distortion=1", 97, 1000},
                      OddSize{"mine,frames=4,width=333,height=251,distortion=1", 333, 1000},
                      OddSize{"quarry,frames=2,width=384,height=216", 65, 1000, 5},
                      OddSize{"quarry,frames=1,width=384,height=216", 1280, kMaxPointsPerLevel,
                              5}));

}  // namespace
}  // namespace darkling
