// SPDX-License-Identifier: Apache-2.0
#include "kernels/saliency.h"

#include <algorithm>
#include <cstdlib>

#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::pixels_of;

constexpr int kMaxWidth = 3 * 4 + 6;  // px of eight bytes, past three of the widest vectors

// The definition, one pixel and plane at a time.
std::vector<std::uint16_t> saliency_oracle(const ImageView<const std::uint8_t>& planes) {
  const int w = planes.width / kPlaneCount;
  const int h = planes.height;
  const auto phi = [&](int x, int y, int c) { return int{planes.at(x * kPlaneCount + c, y)}; };
  std::vector<std::uint16_t> saliency(static_cast<std::size_t>(w * h), 0);
  for (int i = 0; i < w * h; ++i) {
    const int x = i % w;
    const int y = i / w;
    if (x == 0 || y == 0 || x == w - 1 || y == h - 1) continue;
    int sum = 0;
    for (int c = 0; c < kPlaneCount; ++c) {
      sum += std::abs(phi(x + 1, y, c) - phi(x - 1, y, c));
      sum += std::abs(phi(x, y + 1, c) - phi(x, y - 1, c));
    }
    saliency[i] = static_cast<std::uint16_t>(sum);
  }
  return saliency;
}

class EachSaliency : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachSaliency, EqualsTheOracleAndTheReferenceOnEveryShapeAndFill) {
  unsigned seed = 1;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    for (const Fill fill : test::kAllFills) {
      SCOPED_TRACE(test::describe(layout, fill));
      GuardedImage<std::uint8_t> planes(
          test::resized(layout, layout.width * kPlaneCount, layout.height));
      GuardedImage<std::uint16_t> dst(layout);
      GuardedImage<std::uint16_t> expected(layout);
      test::fill_image(planes.view(), fill, seed++);
      GetParam().saliency(planes.view(), dst.view());
      saliency_ref(planes.view(), expected.view());
      ASSERT_EQ(pixels_of(dst.view()), saliency_oracle(planes.view()));
      ASSERT_EQ(pixels_of(dst.view()), pixels_of(expected.view()));
      ASSERT_TRUE(planes.padding_is_untouched());
      ASSERT_TRUE(dst.padding_is_untouched());
    }
  });
}

TEST_P(EachSaliency, ReachesItsMaximumWithoutOverflow) {
  GuardedImage<std::uint8_t> planes({.width = 3 * kPlaneCount, .height = 3});
  GuardedImage<std::uint16_t> dst({.width = 3, .height = 3});
  std::fill_n(planes.view().data, 9 * kPlaneCount, std::uint8_t{0});
  for (int c = 0; c < kPlaneCount; ++c) {
    planes.view().at(2 * kPlaneCount + c, 1) = 255;
    planes.view().at(kPlaneCount + c, 0) = 255;
  }
  GetParam().saliency(planes.view(), dst.view());
  EXPECT_EQ(dst.view().at(1, 1), 4080);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachSaliency, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
