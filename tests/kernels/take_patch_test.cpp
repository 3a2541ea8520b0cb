// SPDX-License-Identifier: Apache-2.0
#include "kernels/take_patch.h"

#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;

class EachTakePatch : public ::testing::TestWithParam<KernelTable> {};

// The contract, plane by plane, in doubles.
void expect_patch(const ImageView<const std::uint8_t>& planes, int x, int y,
                  const PlanePatch& patch, const GramMatrix4& S4) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (int c = 0; c < kPlaneCount; ++c) {
    const auto phi = [&](int i, int j) { return 1.0 * planes.at(i * kPlaneCount + c, j); };
    const double gx = 0.5 * (phi(x + 1, y) - phi(x - 1, y));
    const double gy = 0.5 * (phi(x, y + 1) - phi(x, y - 1));
    ASSERT_EQ(patch.reference[c], phi(x, y));
    ASSERT_EQ(0.5 * patch.gx2[c], gx);
    ASSERT_EQ(0.5 * patch.gy2[c], gy);
    xx += gx * gx;
    xy += gx * gy;
    yy += gy * gy;
  }
  ASSERT_EQ(0.25 * S4.xx, xx);
  ASSERT_EQ(0.25 * S4.xy, xy);
  ASSERT_EQ(0.25 * S4.yy, yy);
}

// Guarded on either side: a patch is all of an image of 3×3 pixels.
TEST_P(EachTakePatch, HoldsValuesGradientsAndTheirGramMatrix) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Fill fill = test::kAllFills[seed % std::size(test::kAllFills)];
    const auto guard =
        seed % 2 == 0 ? test::GuardSide::kBehindLastRow : test::GuardSide::kBeforeFirstRow;
    GuardedImage<std::uint8_t> planes({.width = 3 * kPlaneCount,
                                       .height = 3,
                                       .row_padding = static_cast<int>(seed % 5),
                                       .guard = guard});
    test::fill_image(planes.view(), fill, seed);
    const ImageView<std::uint8_t> view = planes.view();
    PlanePatch patch;
    const GramMatrix4 S4 = GetParam().take_patch(view.row(1) + kPlaneCount, view.stride, patch);
    ASSERT_NO_FATAL_FAILURE(expect_patch(view, 1, 1, patch, S4)) << seed;
  }
}

TEST_P(EachTakePatch, HoldsTheSteepestGradientsThereAre) {
  GuardedImage<std::uint8_t> planes({.width = 3 * kPlaneCount, .height = 3});
  const ImageView<std::uint8_t> view = planes.view();
  for (int y = 0; y < 3; ++y) {
    for (int i = 0; i < 3 * kPlaneCount; ++i) {
      view.at(i, y) = (y == 0 || i < kPlaneCount) && i < 2 * kPlaneCount ? 0 : 255;
    }
  }
  PlanePatch patch;
  const GramMatrix4 S4 = GetParam().take_patch(view.row(1) + kPlaneCount, view.stride, patch);
  EXPECT_EQ(S4.xx, 8 * 255 * 255);
  EXPECT_EQ(S4.xy, 8 * 255 * 255);
  EXPECT_EQ(S4.yy, 8 * 255 * 255);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachTakePatch, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
