// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "drivers/synthetic/rover_path.h"
#include "drivers/synthetic/scene.h"

namespace darkling::synthetic {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Drive {
  double length_m = 0.0;
  double fastest_mps = 0.0;
  double slowest_mps = 1e9;
  double fastest_turn_dps = 0.0;
  double largest_jump_m = 0.0;  // against constant velocity
};

Drive drive(const std::string& scene, std::uint64_t seed) {
  SyntheticSpec spec;
  spec.scene = scene;
  spec.seed = seed;
  const RoverPath path = make_path(spec);
  constexpr double kStep_s = 0.05;
  Drive d;
  Vector3 last_step = Vector3::Zero();
  for (int i = 0; i + 1 < 200; ++i) {
    const Se3 T = path.T_scene_body(i * kStep_s).inverse() * path.T_scene_body((i + 1) * kStep_s);
    const double step = T.translation().norm();
    d.length_m += step;
    d.fastest_mps = std::max(d.fastest_mps, step / kStep_s);
    d.slowest_mps = std::min(d.slowest_mps, step / kStep_s);
    d.fastest_turn_dps = std::max(d.fastest_turn_dps, rotation_angle(T) / kDegree / kStep_s);
    if (i > 0) {
      d.largest_jump_m = std::max(d.largest_jump_m, (T.translation() - last_step).norm());
    }
    last_step = T.translation();
  }
  return d;
}

TEST(RoverPath, DrivesSixMetresInTwoHundredFramesWithTurnsAndStops) {
  for (const char* scene : {"mine", "quarry", "corridor"}) {
    for (std::uint64_t seed : {1u, 2u, 3u}) {
      const Drive d = drive(scene, seed);
      EXPECT_GT(d.length_m, 6.0) << scene << seed;
      EXPECT_LT(d.length_m, 10.0) << scene << seed;
      EXPECT_LT(d.fastest_mps, 1.4) << scene << seed;
      EXPECT_LT(d.slowest_mps, 0.05) << scene << seed;
      EXPECT_GT(d.fastest_turn_dps, 20.0) << scene << seed;
      EXPECT_LT(d.fastest_turn_dps, 70.0) << scene << seed;
      EXPECT_LT(d.largest_jump_m, 0.02) << scene << seed;
    }
  }
}

TEST(RoverPath, StandsWhereItStartsAndIsLevelWithoutGround) {
  const RoverPath path({}, {.duration_s = 1.0, .speed_mps = 0.9, .bump_scale = 0.0}, 1);
  const Vector3 p = path.T_scene_body(0.0).translation();
  EXPECT_NEAR(p.x(), 0.0, 1e-9);
  EXPECT_NEAR(p.y(), 0.0, 1e-9);
  EXPECT_NEAR(p.z(), RoverPath::kBodyHeight_m, 1e-12);
  EXPECT_NEAR((path.T_scene_body(0.7).R() * Vector3::UnitZ()).z(), 1.0, 1e-12);
}

TEST(RoverPath, LeansWithTheGround) {
  RoverPath path({}, {.duration_s = 1.0, .speed_mps = 0.0, .bump_scale = 0.0}, 1);
  path.set_ground([](double x, double y) { return 0.1 * x + 0.05 * y; });
  // The ground's normal, to first order of its slopes.
  const Vector3 up = path.T_scene_body(0.5).R() * Vector3::UnitZ();
  EXPECT_NEAR(up.x(), -0.1, 2e-3);
  EXPECT_NEAR(up.y(), -0.05, 2e-3);
}

}  // namespace
}  // namespace darkling::synthetic
