// SPDX-License-Identifier: Apache-2.0
// Windows that must not be refined: each leaves with its reason, and as it was.
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/kernel_cases.h"
#include "support/window_stages.h"

namespace darkling {
namespace {

using test::PlaneWindow;

// A window of four refined keyframes and a fifth that is new, to be spoilt.
class RefineWindowRefuses : public ::testing::Test {
 protected:
  void expect(Refinement outcome) {
    const std::vector<double> before = test::estimate_of(window());
    EXPECT_STREQ(kRefinementNames[int(stages_.refine())], kRefinementNames[int(outcome)]);
    EXPECT_EQ(test::estimate_of(window()), before);
  }
  Window& window() { return stages_.window(); }
  void put_newest(const Se3& T_newest_wrong) {
    window().newest().T_world_key = window().newest().T_world_key * T_newest_wrong;
  }

  test::PlaneWorld world_;
  PlaneWindow stages_{world_};
};

TEST_F(RefineWindowRefuses, NothingOfAGoodWindow) {
  const std::vector<double> before = test::estimate_of(window());
  EXPECT_EQ(stages_.refine(), Refinement::kApplied);
  EXPECT_NE(test::estimate_of(window()), before);
}

TEST_F(RefineWindowRefuses, TooFewPoints) {
  for (WindowKeyframe& keyframe : window().keyframes()) keyframe.points.count = 7;
  expect(Refinement::kTooFewPoints);
  for (WindowKeyframe& keyframe : window().keyframes()) keyframe.points.count = 0;
  expect(Refinement::kTooFewPoints);
}

TEST_F(RefineWindowRefuses, ANewestKeyframeThatLooksTheOtherWay) {
  put_newest(test::motion(0, 0, 0, 0, 3.1, 0));
  expect(Refinement::kTooFewPoints);
}

TEST_F(RefineWindowRefuses, ANewestKeyframeTwentyPixelsOff) {
  for (const double angle : {20.0 / 120.0, -20.0 / 120.0}) {
    put_newest(test::motion(0, 0, 0, 0, angle, 0));
    expect(Refinement::kDisagreement);
    put_newest(test::motion(0, 0, 0, 0, -angle, 0));
    put_newest(test::motion(0, 0, 0, angle, 0, 0));
    expect(Refinement::kDisagreement);
    put_newest(test::motion(0, 0, 0, -angle, 0, 0));
  }
}

TEST_F(RefineWindowRefuses, ANewestKeyframeThatIsSomewhere) {
  test::Random random(6);
  const Se3 good = window().newest().T_world_key;
  for (int trial = 0; trial < 40; ++trial) {
    Vector6 xi;
    xi << random.vector<3>(1.0), random.vector<3>(0.3);
    window().newest().T_world_key = plus(good, xi);
    const std::vector<double> before = test::estimate_of(window());
    EXPECT_NE(stages_.refine(), Refinement::kApplied) << trial;
    EXPECT_EQ(test::estimate_of(window()), before) << trial;
  }
}

TEST_F(RefineWindowRefuses, AnImageOfSomethingElse) {
  for (const std::uint64_t seed : {11u, 12u, 13u}) {
    const test::PlaneWorld elsewhere({.seed = seed});
    elsewhere.render(stages_.rig(), PlaneWindow::T_world_true(4), stages_.eye().grey());
    stages_.eye().prepare(stages_.kernels());
    expect(Refinement::kDisagreement);
  }
}

TEST_F(RefineWindowRefuses, NoiseAndAnImageOfOneGrey) {
  for (const test::Fill fill : {test::Fill::kUniform, test::Fill::kConstant}) {
    test::fill_image(stages_.eye().grey(), fill, 1);
    stages_.eye().prepare(stages_.kernels());
    SCOPED_TRACE(test::name_of(fill));
    expect(Refinement::kDisagreement);
  }
}

// Further than tracking can have erred: of a keyframe in the middle, as the newest's own images
// would not agree.
TEST_F(RefineWindowRefuses, AStepOfPixels) {
  Se3& T_world_key = window().keyframes()[2].T_world_key;
  T_world_key = T_world_key * test::motion(0, 0, 0, 0, 2.5 / 120.0, 0);
  expect(Refinement::kStepTooLarge);
}

TEST_F(RefineWindowRefuses, NoPointAtInfinityAmongOthers) {
  for (WindowKeyframe& keyframe : window().keyframes()) {
    for (int i = 0; i < keyframe.points.count; i += 10) {
      keyframe.points.inverse_depth_focal[i] = 0.0f;
    }
  }
  EXPECT_EQ(stages_.refine(), Refinement::kApplied);
  for (const double number : test::estimate_of(window())) ASSERT_TRUE(std::isfinite(number));
  for (const WindowKeyframe& keyframe : window().keyframes()) {
    for (int i = 0; i < keyframe.points.count; ++i) {
      ASSERT_GE(keyframe.points.inverse_depth_focal[i], 0.0f);
    }
  }
}

// Keyframes that stand still, so that every comparison agrees, before what does not show every
// motion.
void expect_ill_conditioned(test::WindowStages& stages) {
  const std::vector<double> before = test::estimate_of(stages.window());
  EXPECT_EQ(stages.refine(), Refinement::kIllConditioned);
  EXPECT_EQ(test::estimate_of(stages.window()), before);
}

// No translation shows.
TEST(RefineIllConditionedWindow, OfPointsThatAreAllAtInfinity) {
  const auto wave = [](int x, int y) {
    return 128.0 + 60.0 * std::sin(0.7 * x) * std::cos(0.5 * y);
  };
  test::WindowStages stages(test::ideal_rig(), {.disparity_sigma_px = 0.0});
  test::WindowStages near(test::ideal_rig(), {.disparity_sigma_px = 0.1});
  for (int k = 0; k < 3; ++k) {
    stages.add_painting(wave, 0.0f);
    near.add_painting(wave, 4.0f);
    if (k == 0) continue;
    expect_ill_conditioned(stages);
    EXPECT_NE(near.refine(), Refinement::kIllConditioned);
  }
}

// No motion along the stripes shows.
TEST(RefineIllConditionedWindow, OfStripes) {
  test::WindowStages stages(test::ideal_rig(), {});
  for (int k = 0; k < 3; ++k) {
    stages.add_painting([](int x, int) { return 128.0 + 60.0 * std::sin(0.02 * x * (x % 17)); },
                        4.0f);
    if (k > 0) expect_ill_conditioned(stages);
  }
  EXPECT_GT(stages.window().newest().points.count, 100);
}

// To climb looks like to nod.
TEST(RefineIllConditionedWindow, OfOneLineOfTexture) {
  test::WindowStages stages(test::ideal_rig(), {.points = 1000, .disparity_sigma_px = 0.0});
  for (int k = 0; k < 5; ++k) {
    stages.add_painting(
        [](int x, int y) {
          return std::abs(y - 60) < 2 ? 128.0 + 60.0 * std::sin(0.02 * x * (x % 17)) : 128.0;
        },
        4.0f);
    if (k > 1) expect_ill_conditioned(stages);
  }
  EXPECT_GT(stages.window().newest().points.count, 30);
}

}  // namespace
}  // namespace darkling
