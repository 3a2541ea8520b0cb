// SPDX-License-Identifier: Apache-2.0
#include "support/guarded_image.h"

#include <cstdint>

#include "support/guarded_points.h"

namespace darkling::test {
namespace {

constexpr GuardedLayout kPadded = {
    .width = 5, .height = 3, .row_padding = 3, .distance_to_guard = 9};

TEST(GuardedImage, IsUntouchedWhenOnlyPixelsAreWritten) {
  GuardedImage<std::uint16_t> image(kPadded);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) image.view().at(x, y) = 0;
  }
  EXPECT_TRUE(image.padding_is_untouched());
}

TEST(GuardedImage, NoticesAWriteOnEverySideOfTheRows) {
  const struct {
    const char* side;
    int x;
    int y;
  } writes[] = {
      {"left of the first row", -1, 0}, {"right of a row", 5, 1}, {"left of a row", -1, 2},
      {"right of the last row", 5, 2},  {"above", 2, -1},         {"below", 0, 3}};
  for (const auto& write : writes) {
    SCOPED_TRACE(write.side);
    GuardedImage<std::uint8_t> image(kPadded);
    ASSERT_TRUE(image.padding_is_untouched());
    std::uint8_t* pixel = image.view().row(write.y) + write.x;
    *pixel = static_cast<std::uint8_t>(*pixel + 1);
    EXPECT_FALSE(image.padding_is_untouched());
  }
}

TEST(GuardedImage, DiesOnAReadBehindTheLastRow) {
  GuardedImage<std::uint8_t> image({.width = 5, .height = 3, .row_padding = 3});
  const volatile std::uint8_t* past = image.view().row(2) + 5;
  EXPECT_DEATH((void)*past, "");
}

TEST(GuardedImage, DiesOnAReadBeforeTheFirstRow) {
  GuardedImage<std::uint8_t> image(
      {.width = 5, .height = 3, .row_padding = 3, .guard = GuardSide::kBeforeFirstRow});
  const volatile std::uint8_t* before = image.view().row(0) - 1;
  EXPECT_DEATH((void)*before, "");
}

TEST(GuardedImage, StartsWhereTheLayoutSays) {
  GuardedImage<std::uint8_t> image(
      {.width = 5, .height = 3, .distance_to_guard = 7, .guard = GuardSide::kBeforeFirstRow});
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.view().data) % 64, 7U);
}

TEST(GuardedPoints, HaveRoomForWholeLanesAndNoticeAWriteBeforeEveryArray) {
  for (int array = 0; array < 7; ++array) {
    SCOPED_TRACE(array);
    GuardedPoints guarded(9);
    TemplatePoints& points = guarded.points();
    float* const floats[] = {points.x,   points.y,   points.inverse_depth_focal,
                             points.Sxx, points.Sxy, points.Syy};
    for (float* values : floats) std::fill_n(values, 16, 0.0f);
    std::fill_n(points.patches, 16, PlanePatch());
    ASSERT_TRUE(guarded.padding_is_untouched());
    if (array < 6) floats[array][-1] = 0.0f;
    if (array == 6) points.patches[-1] = {};
    EXPECT_FALSE(guarded.padding_is_untouched());
  }
}

TEST(GuardedResiduals, NoticeAWriteBeforeEveryArrayAndDieOnOneBehind) {
  for (int array = 0; array < 3; ++array) {
    GuardedResiduals guarded(3);
    const PointResiduals out = guarded.out();
    float* const floats[] = {out.bx, out.by, out.squares};
    std::fill_n(floats[array], 8, 0.0f);
    ASSERT_TRUE(guarded.padding_is_untouched());
    floats[array][-1] = 0.0f;
    EXPECT_FALSE(guarded.padding_is_untouched()) << array;
    EXPECT_DEATH(floats[array][8] = 0.0f, "") << array;
  }
}

}  // namespace
}  // namespace darkling::test
