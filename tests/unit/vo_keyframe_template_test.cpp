// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include "support/kernel_cases.h"
#include "support/pixels.h"
#include "support/vo_stages.h"
#include "vo/keyframe_template.h"

namespace darkling {
namespace {

constexpr int kPoints = 300;

// A textured eye and the true disparities of what it sees.
class SelectPoints : public ::testing::Test {
 protected:
  SelectPoints() {
    world_.render(rig_, Se3(), eye_.grey());
    eye_.prepare(kernels_);
    stages_.know_disparities(world_, Se3());
  }
  [[nodiscard]] auto select(int level) {
    return select_points(kernels_, eye_.pyramid()[level], stages_.disparities_at(level),
                         stages_.selector());
  }

  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::PlaneWorld world_;
  test::EyeStages eye_{rig_, 3};
  test::TemplateStages stages_{rig_, 3, kPoints};
};

// How many cells of a grid hold no candidate; cells reach over the whole image.
int empty_cells(std::span<const PointSelector::Candidate> candidates, int width, int height,
                int columns, int rows) {
  std::set<std::pair<int, int>> held;
  for (const PointSelector::Candidate& c : candidates) {
    held.insert({c.x * columns / width, c.y * rows / height});
  }
  return columns * rows - static_cast<int>(held.size());
}

TEST_F(SelectPoints, SpreadsOverTheTextureOnEveryLevel) {
  for (int level = 0; level < 3; ++level) {
    const auto chosen = select(level);
    EXPECT_LE(chosen.size(), std::size_t{kPoints});
    EXPECT_GE(chosen.size(), std::size_t{kPoints} * 3 / 4) << level;
    // Coarser than the selection's own grid, so that points may lie anywhere in a cell.
    const PyramidLevel& planes = eye_.pyramid()[level];
    EXPECT_EQ(empty_cells(chosen, planes.grey.width, planes.grey.height, 8, 6), 0) << level;
  }
}

TEST_F(SelectPoints, LeavesNoCellEmptyIsAClaimThatCanFail) {
  const auto chosen = select(0);
  const auto half = chosen.first(chosen.size() / 2);  // the upper half: cells go row by row
  EXPECT_GE(empty_cells(half, rig_.width, rig_.height, 8, 6), 8 * 2);
}

TEST_F(SelectPoints, TakesOnlyPixelsWithADisparity) {
  for (int y = 0; y < rig_.height; ++y) {
    for (int x = 0; x < rig_.width / 2; ++x) stages_.disparity().at(x, y) = kNoDisparity;
  }
  for (int level = 0; level < 3; ++level) {
    const auto chosen = select(level);
    EXPECT_FALSE(chosen.empty());
    for (const PointSelector::Candidate& c : chosen) {
      ASSERT_GE(c.disparity_px, 0.0f);
      ASSERT_GE(c.x, (rig_.width >> level) / 2);
    }
  }
}

TEST_F(SelectPoints, KeepsTwoPixelsFromTheBorderAndNoPixelTwice) {
  for (int level = 0; level < 3; ++level) {
    const PyramidLevel& planes = eye_.pyramid()[level];
    std::set<std::pair<int, int>> seen;
    for (const PointSelector::Candidate& c : select(level)) {
      ASSERT_TRUE(c.x >= 2 && c.x < planes.grey.width - 2) << c.x;
      ASSERT_TRUE(c.y >= 2 && c.y < planes.grey.height - 2) << c.y;
      ASSERT_TRUE(seen.insert({c.x, c.y}).second);
    }
  }
}

TEST_F(SelectPoints, TakesTheMostSalientOfItsSurroundings) {
  const auto chosen = select(0);
  Arena arena(1u << 20);
  const auto saliency = arena.allocate_image<std::uint16_t>(rig_.width, rig_.height, "saliency");
  saliency_ref(eye_.pyramid()[0].planes, saliency);
  double sum_all = 0.0;
  for (const std::uint16_t value : test::pixels_of(saliency)) sum_all += value;
  double sum_chosen = 0.0;
  for (const PointSelector::Candidate& c : chosen) {
    ASSERT_EQ(c.saliency, saliency.at(c.x, c.y) / 2 * 2);  // kept in steps of two
    sum_chosen += c.saliency;
  }
  const double mean_all = sum_all / (rig_.width * rig_.height);
  EXPECT_GT(sum_chosen / static_cast<double>(chosen.size()), 1.2 * mean_all);
}

TEST_F(SelectPoints, GivesDisparitiesInThePixelsOfTheLevel) {
  for (int level = 0; level < 3; ++level) {
    const double factor = 1 << level;
    for (const PointSelector::Candidate& c : select(level)) {
      const double u = (c.x + 0.5) * factor - 0.5;
      const double v = (c.y + 0.5) * factor - 0.5;
      const double truth = rig_.focal_px * rig_.baseline_m / world_.depth_m(rig_, Se3(), u, v);
      // The median of a block where floor and wall slant: half a row of it either way.
      ASSERT_NEAR(c.disparity_px, truth / factor, level == 0 ? 1e-5 : 0.12) << u << " " << v;
    }
  }
}

// A disparity map of half the size, whose pixel (x, y) stands for 2×2 of level 0.
TEST_F(SelectPoints, TakesDisparitiesOfAMatchedCoarserLevelToEveryOther) {
  Arena arena(1u << 20);
  DisparityPyramid disparities = allocate_disparities(rig_.width, rig_.height, 3, 1, arena);
  const ImageView<float> coarse = disparities.levels[0];
  const auto coarse_at = [](int x, int y) { return 0.25f + 0.0625f * float(x + 10 * y); };
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      coarse.at(x, y) = x % 7 == 0 ? kNoDisparity : coarse_at(x, y);
    }
  }
  reduce_disparities(disparities);
  const auto select_on = [&](int level) {
    return select_points(kernels_, eye_.pyramid()[level], disparities.at_level(level),
                         stages_.selector());
  };
  for (const PointSelector::Candidate& c : select_on(0)) {
    ASSERT_TRUE(c.x / 2 % 7 >= 2 && c.x / 2 % 7 <= 5) << c.x;  // no unknown neighbour either
    ASSERT_EQ(c.disparity_px, 2.0f * coarse_at(c.x / 2, c.y / 2));
  }
  for (const PointSelector::Candidate& c : select_on(1)) {
    ASSERT_NE(c.x % 7, 0);
    ASSERT_EQ(c.disparity_px, coarse_at(c.x, c.y));
  }
  for (const PointSelector::Candidate& c : select_on(2)) {
    // The median of the known of 2×2: between the least and the greatest.
    ASSERT_GE(2.0f * c.disparity_px, coarse_at(2 * c.x, 2 * c.y));
    ASSERT_LE(2.0f * c.disparity_px, coarse_at(2 * c.x + 1, 2 * c.y + 1));
  }
  EXPECT_GT(select_on(0).size(), std::size_t{kPoints} / 2);  // or nothing was compared
}

// From a coarser level: not beside an edge of depth, where the search would pick either side.
TEST_F(SelectPoints, KeepsClearOfStepsInACoarserDisparityMap) {
  Arena arena(1u << 20);
  DisparityPyramid disparities = allocate_disparities(rig_.width, rig_.height, 2, 1, arena);
  const ImageView<float> coarse = disparities.levels[0];
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) coarse.at(x, y) = x < 40 ? 3.0f : 5.0f;
  }
  const auto chosen =
      select_points(kernels_, eye_.pyramid()[0], disparities.at_level(0), stages_.selector());
  EXPECT_GT(chosen.size(), std::size_t{kPoints} / 2);
  for (const PointSelector::Candidate& c : chosen) {
    ASSERT_TRUE(c.x / 2 < 39 || c.x / 2 > 40) << c.x;
  }
}

TEST_F(SelectPoints, StaysInsideADisparityMapOfAnOddSizeHalved) {
  RectifiedRig odd = rig_;
  odd.width = 161;
  odd.height = 121;
  test::EyeStages eye(odd, 2);
  world_.render(odd, Se3(), eye.grey());
  eye.prepare(kernels_);
  Arena arena(1u << 20);
  const DisparityPyramid disparities = allocate_disparities(161, 121, 2, 1, arena);
  const ImageView<float> coarse = disparities.levels[0];
  for (int i = 0; i < 80 * 60; ++i) coarse.at(i % 80, i / 80) = 3.0f;
  const PointSelector selector = allocate_point_selector(odd, kPoints, arena);
  const auto chosen = select_points(kernels_, eye.pyramid()[0], disparities.at_level(0), selector);
  EXPECT_GE(chosen.size(), std::size_t{kPoints} * 3 / 4);
  for (const PointSelector::Candidate& c : chosen) ASSERT_EQ(c.disparity_px, 6.0f);
}

TEST_F(SelectPoints, FindsNothingInAFlatImage) {
  test::fill_image(eye_.grey(), test::Fill::kConstant, 90);
  eye_.prepare(kernels_);
  for (int level = 0; level < 3; ++level) EXPECT_TRUE(select(level).empty());
}

TEST_F(SelectPoints, GivesTheSamePointsWithEveryKernel) {
  const auto key_of = [](const PointSelector::Candidate& c) {
    return std::tuple(c.x, c.y, c.saliency, c.disparity_px);
  };
  std::vector<decltype(key_of({}))> expected;
  for (const KernelTable& kernels : test::available_tables()) {
    eye_.prepare(kernels);
    std::vector<decltype(key_of({}))> points;
    for (const auto& c :
         select_points(kernels, eye_.pyramid()[0], stages_.disparities_at(0), stages_.selector())) {
      points.push_back(key_of(c));
    }
    if (expected.empty()) expected = points;
    EXPECT_EQ(points, expected) << kernels.name;
  }
}

TEST_F(SelectPoints, AreBuiltIntoATemplateOfReferenceGradientsAndGram) {
  const PyramidLevel& level = eye_.pyramid()[1];
  auto chosen = select(1);
  TemplateLevel& out = stages_.keyframe().levels[1];
  ASSERT_EQ(out.capacity, kPoints / 2);
  chosen = chosen.first(std::min<std::size_t>(chosen.size(), kPoints / 2));
  build_template_level(kernels_, chosen, level, rig_.baseline_m, out);
  const TemplatePoints& points = out.points;
  ASSERT_EQ(static_cast<std::size_t>(points.count), chosen.size());
  double sum = 0.0;
  for (int i = 0; i < points.count; ++i) {
    const PointSelector::Candidate& c = chosen[static_cast<std::size_t>(i)];
    const PlanePatch& patch = points.patches[i];
    ASSERT_NEAR(points.x[i], c.x - level.cx, 1e-5);
    ASSERT_NEAR(points.y[i], c.y - level.cy, 1e-5);
    ASSERT_NEAR(points.inverse_depth_focal[i], c.disparity_px / rig_.baseline_m, 1e-4);
    sum += points.inverse_depth_focal[i];
    Eigen::Matrix2d S = Eigen::Matrix2d::Zero();
    for (int k = 0; k < kPlaneCount; ++k) {
      const auto phi = [&](int x, int y) { return 1.0 * level.planes.at(x * kPlaneCount + k, y); };
      const Eigen::Vector2d gradient(0.5 * (phi(c.x + 1, c.y) - phi(c.x - 1, c.y)),
                                     0.5 * (phi(c.x, c.y + 1) - phi(c.x, c.y - 1)));
      ASSERT_EQ(patch.reference[k], phi(c.x, c.y));
      ASSERT_EQ(patch.gx2[k], 2.0 * gradient.x());
      ASSERT_EQ(patch.gy2[k], 2.0 * gradient.y());
      S += gradient * gradient.transpose();
    }
    ASSERT_EQ(points.Sxx[i], S(0, 0));  // quarters of whole numbers: exact
    ASSERT_EQ(points.Sxy[i], S(0, 1));
    ASSERT_EQ(points.Syy[i], S(1, 1));
  }
  EXPECT_NEAR(out.mean_inverse_depth_focal, sum / points.count, 1e-4);
}

TEST_F(SelectPoints, BuildAnEmptyTemplateOfNoPoints) {
  TemplateLevel& out = stages_.keyframe().levels[0];
  build_template_level(kernels_, {}, eye_.pyramid()[0], rig_.baseline_m, out);
  EXPECT_EQ(out.points.count, 0);
  EXPECT_EQ(out.mean_inverse_depth_focal, 0.0f);
  EXPECT_TRUE(stages_.keyframe().is_empty());
}

}  // namespace
}  // namespace darkling
