// SPDX-License-Identifier: Apache-2.0
#include "kernels/blur3.h"

#include <opencv2/imgproc.hpp>

#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::pixels_of;

constexpr int kMaxWidth = 3 * 32 + 4;  // px, past three of the widest vectors

// The convolution as OpenCV does it, in doubles and so exact, rounded half up afterwards.
std::vector<std::uint8_t> blur_oracle(const ImageView<const std::uint8_t>& image) {
  std::vector<std::uint8_t> pixels = pixels_of(image);
  const cv::Mat src(image.height, image.width, CV_8UC1, pixels.data());
  const cv::Mat taps = (cv::Mat_<double>(1, 3) << 0.25, 0.5, 0.25);
  cv::Mat blurred;
  cv::sepFilter2D(src, blurred, CV_64F, taps, taps, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  std::vector<std::uint8_t> rounded;
  for (const double value : cv::Mat_<double>(blurred)) {
    rounded.push_back(static_cast<std::uint8_t>(test::round_half_up(value)));
  }
  return rounded;
}

class EachBlur3 : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachBlur3, EqualsOpenCvOnEveryShapeAndFill) {
  unsigned seed = 1;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    for (const Fill fill : test::kAllFills) {
      SCOPED_TRACE(test::describe(layout, fill));
      GuardedImage<std::uint8_t> src(layout);
      GuardedImage<std::uint8_t> dst(layout);
      test::fill_image(src.view(), fill, seed++);
      const std::vector<std::uint8_t> before = pixels_of(src.view());
      GetParam().blur3(src.view(), dst.view());
      ASSERT_EQ(pixels_of(dst.view()), blur_oracle(src.view()));
      ASSERT_EQ(pixels_of(src.view()), before);
      ASSERT_TRUE(src.padding_is_untouched());
      ASSERT_TRUE(dst.padding_is_untouched());
    }
  });
}

TEST_P(EachBlur3, EqualsTheReferenceBitForBit) {
  unsigned seed = 1000;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    SCOPED_TRACE(test::describe(layout));
    GuardedImage<std::uint8_t> src(layout);
    // Another stride and start than the source: nothing may assume that they agree.
    GuardedImage<std::uint8_t> dst({.width = layout.width,
                                    .height = layout.height,
                                    .row_padding = layout.row_padding + 3,
                                    .distance_to_guard = 5});
    GuardedImage<std::uint8_t> expected(layout);
    test::fill_image(src.view(), Fill::kUniform, seed++);
    blur3_ref(src.view(), expected.view());
    GetParam().blur3(src.view(), dst.view());
    ASSERT_EQ(pixels_of(dst.view()), pixels_of(expected.view()));
  });
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachBlur3, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

TEST(Blur3, RoundsHalfUp) {
  const std::uint8_t src[9] = {0, 0, 0,  //
                               0, 2, 0,  //
                               0, 0, 0};
  std::uint8_t dst[9] = {};
  blur3_ref({src, 3, 3, 3}, {dst, 3, 3, 3});
  EXPECT_EQ(dst[4], 1);  // 8/16
  EXPECT_EQ(dst[1], 0);  // 4/16
}

}  // namespace
}  // namespace darkling
