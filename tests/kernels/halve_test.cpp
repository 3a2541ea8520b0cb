// SPDX-License-Identifier: Apache-2.0
#include "kernels/halve.h"

#include <opencv2/imgproc.hpp>

#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::pixels_of;

constexpr int kMaxWidth = 2 * (3 * 32 + 1) + 1;  // px of source, past three of the widest vectors

// Box means by OpenCV in doubles, rounded half up.
std::vector<std::uint8_t> halve_oracle(const ImageView<const std::uint8_t>& image) {
  std::vector<std::uint8_t> pixels = pixels_of(image);
  const cv::Mat src(image.height, image.width, CV_8UC1, pixels.data());
  const cv::Size half(image.width / 2, image.height / 2);
  cv::Mat means;
  src(cv::Rect({0, 0}, half * 2)).convertTo(means, CV_64F);
  cv::resize(means, means, half, 0.0, 0.0, cv::INTER_AREA);
  std::vector<std::uint8_t> rounded;
  for (const double value : cv::Mat_<double>(means)) {
    rounded.push_back(static_cast<std::uint8_t>(test::round_half_up(value)));
  }
  return rounded;
}

class EachHalve : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachHalve, EqualsOpenCvAndTheReferenceOnEveryShapeAndFill) {
  unsigned seed = 1;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure() || layout.width < 2 || layout.height < 2) return;
    const Fill fill = test::kAllFills[seed % std::size(test::kAllFills)];
    SCOPED_TRACE(test::describe(layout, fill));
    const GuardedLayout half = test::resized(layout, layout.width / 2, layout.height / 2);
    GuardedImage<std::uint8_t> src(layout);
    GuardedImage<std::uint8_t> dst(half);
    GuardedImage<std::uint8_t> expected(half);
    test::fill_image(src.view(), fill, seed++);
    const std::vector<std::uint8_t> before = pixels_of(src.view());
    GetParam().halve(src.view(), dst.view());
    halve_ref(src.view(), expected.view());
    ASSERT_EQ(pixels_of(dst.view()), halve_oracle(src.view()));
    ASSERT_EQ(pixels_of(dst.view()), pixels_of(expected.view()));
    ASSERT_EQ(pixels_of(src.view()), before);
    ASSERT_TRUE(src.padding_is_untouched());
    ASSERT_TRUE(dst.padding_is_untouched());
  });
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachHalve, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

TEST(Halve, RoundsHalfUpAndLeavesOutTheOddColumnAndRow) {
  const std::uint8_t src[15] = {0, 1, 5, 4, 200,  //
                                1, 0, 5, 4, 200,  //
                                9, 9, 9, 9, 9};
  std::uint8_t dst[2] = {};
  halve_ref({src, 5, 3, 5}, {dst, 2, 1, 2});
  EXPECT_EQ(dst[0], 1);  // 2/4
  EXPECT_EQ(dst[1], 5);  // 18/4
}

}  // namespace
}  // namespace darkling
