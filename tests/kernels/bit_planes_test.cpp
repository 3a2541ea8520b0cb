// SPDX-License-Identifier: Apache-2.0
#include "kernels/bit_planes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::pixels_of;
using test::round_half_up;

constexpr int kMaxWidth = 3 * 4 + 6;  // px of eight bytes, past three of the widest vectors
constexpr double kSigmas_px[] = {0.0, 0.5, 1.0, 1.25, 1.75};

// One plane of the codes, 0 or 255, h × w.
cv::Mat plane_of(const ImageView<const std::uint8_t>& codes, int c) {
  cv::Mat plane(codes.height, codes.width, CV_64F);
  for (int y = 0; y < codes.height; ++y) {
    for (int x = 0; x < codes.width; ++x) {
      plane.at<double>(y, x) = (codes.at(x, y) >> c & 1) != 0 ? 255.0 : 0.0;
    }
  }
  return plane;
}

// Both taps in one row, symmetric, as a fraction.
cv::Mat kernel_of(const SmoothingTaps& taps) {
  cv::Mat kernel(1, 2 * taps.radius + 1, CV_64F);
  for (int k = -taps.radius; k <= taps.radius; ++k) {
    kernel.at<double>(0, taps.radius + k) = taps.w[std::abs(k)] / 64.0;
  }
  return kernel;
}

void round_all(cv::Mat& image) {
  for (double& value : cv::Mat_<double>(image)) value = round_half_up(value);
}

enum class Rounding { kEachDirection, kNever };

// Every plane by OpenCV in doubles, interleaved.
std::vector<double> planes_oracle(const ImageView<const std::uint8_t>& codes,
                                  const SmoothingTaps& taps, Rounding rounding) {
  const cv::Mat one = cv::Mat::ones(1, 1, CV_64F);
  const cv::Mat kernel = kernel_of(taps);
  std::vector<double> planes(static_cast<std::size_t>(codes.width * codes.height * kPlaneCount));
  for (int c = 0; c < kPlaneCount; ++c) {
    cv::Mat plane = plane_of(codes, c);
    cv::sepFilter2D(plane, plane, CV_64F, one, kernel, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
    if (rounding == Rounding::kEachDirection) round_all(plane);
    cv::sepFilter2D(plane, plane, CV_64F, kernel, one, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
    if (rounding == Rounding::kEachDirection) round_all(plane);
    for (int i = 0; i < codes.width * codes.height; ++i) {
      planes[i * kPlaneCount + c] = plane.at<double>(i / codes.width, i % codes.width);
    }
  }
  return planes;
}

class EachBitPlanes : public ::testing::TestWithParam<KernelTable> {
 protected:
  // Compares with the oracle and the reference, all memory guarded.
  static void check(BitPlanesFn* bit_planes, const GuardedLayout& layout, Fill fill,
                    const SmoothingTaps& taps, unsigned seed) {
    SCOPED_TRACE(test::describe(layout, fill));
    const int width = layout.width;
    const GuardedLayout bytes = test::resized(layout, width * kPlaneCount, layout.height);
    GuardedImage<std::uint8_t> codes(layout);
    GuardedImage<std::uint8_t> dst(bytes);
    GuardedImage<std::uint8_t> expected(bytes);
    GuardedImage<std::uint8_t> scratch(
        {.width = kPlaneCount * (width + 2 * SmoothingTaps::kMaxRadius), .height = 1});
    test::fill_image(codes.view(), fill, seed);
    bit_planes(codes.view(), taps, scratch.view().data, dst.view());
    const std::vector<std::uint8_t> planes = pixels_of(dst.view());
    ASSERT_EQ(std::vector<double>(planes.begin(), planes.end()),
              planes_oracle(codes.view(), taps, Rounding::kEachDirection));
    bit_planes_ref(codes.view(), taps, scratch.view().data, expected.view());
    ASSERT_EQ(planes, pixels_of(expected.view()));
    ASSERT_TRUE(codes.padding_is_untouched());
    ASSERT_TRUE(dst.padding_is_untouched());
    ASSERT_TRUE(scratch.padding_is_untouched());
  }
};

TEST_P(EachBitPlanes, EqualOpenCvAndTheReferenceOnEveryShape) {
  unsigned seed = 1;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    const Fill fill = test::kAllFills[seed % std::size(test::kAllFills)];
    const double sigma_px = kSigmas_px[seed % std::size(kSigmas_px)];
    check(GetParam().bit_planes, layout, fill, make_smoothing_taps(sigma_px), seed++);
  });
}

TEST_P(EachBitPlanes, EqualOpenCvInImagesHigherAndWiderThanTheTaps) {
  unsigned seed = 7;
  for (const double sigma_px : kSigmas_px) {
    SCOPED_TRACE(sigma_px);
    for (int height = 6; height <= 12; ++height) {
      check(GetParam().bit_planes, {.width = 37, .height = height, .row_padding = 3},
            Fill::kUniform, make_smoothing_taps(sigma_px), seed++);
    }
  }
}

TEST_P(EachBitPlanes, LieWithinAGreyLevelOfSmoothingWithoutRounding) {
  GuardedImage<std::uint8_t> codes({.width = 40, .height = 30});
  GuardedImage<std::uint8_t> dst({.width = 40 * kPlaneCount, .height = 30});
  std::vector<std::uint8_t> scratch(kPlaneCount * (40 + 2 * SmoothingTaps::kMaxRadius));
  test::fill_image(codes.view(), Fill::kUniform, 3);
  const SmoothingTaps taps = make_smoothing_taps(1.25);
  GetParam().bit_planes(codes.view(), taps, scratch.data(), dst.view());
  const std::vector<std::uint8_t> planes = pixels_of(dst.view());
  const std::vector<double> exact = planes_oracle(codes.view(), taps, Rounding::kNever);
  for (std::size_t i = 0; i < planes.size(); ++i) ASSERT_NEAR(planes[i], exact[i], 1.0);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachBitPlanes, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

TEST(BitPlanes, PutBitCIntoByteCOfItsPixel) {
  const std::uint8_t codes[2] = {0b1010'0001, 0b0000'0010};
  std::uint8_t planes[16] = {};
  std::uint8_t scratch[kPlaneCount * (2 + 2 * SmoothingTaps::kMaxRadius)];
  bit_planes_ref({codes, 2, 1, 2}, make_smoothing_taps(0.0), scratch, {planes, 16, 1, 16});
  const std::uint8_t expected[16] = {255, 0, 0, 0, 0, 255, 0, 255, 0, 255, 0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(std::equal(planes, planes + 16, expected));
}

TEST(SmoothingTaps, SumTo64AndFollowTheGaussian) {
  for (double sigma_px = 0.05; sigma_px <= 1.75; sigma_px += 0.05) {
    SCOPED_TRACE(sigma_px);
    const SmoothingTaps taps = make_smoothing_taps(sigma_px);
    const int sides = std::accumulate(taps.w.begin() + 1, taps.w.end(), 0);
    EXPECT_EQ(taps.w[0] + 2 * sides, 64);
    const cv::Mat gaussian = cv::getGaussianKernel(2 * SmoothingTaps::kMaxRadius + 1, sigma_px);
    for (int k = 0; k <= SmoothingTaps::kMaxRadius; ++k) {
      // Rounding to 1/64; the middle tap takes what the others leave.
      const double bound = k == 0 ? SmoothingTaps::kMaxRadius : 0.5;
      EXPECT_NEAR(taps.w[k], 64.0 * gaussian.at<double>(SmoothingTaps::kMaxRadius + k), bound);
      EXPECT_TRUE(k <= taps.radius || taps.w[k] == 0) << k;
    }
  }
}

TEST(SmoothingTaps, RefuseASigmaThatTheyCannotHold) {
  EXPECT_DEATH((void)make_smoothing_taps(1.8), "smoothing sigma");
  EXPECT_DEATH((void)make_smoothing_taps(-0.1), "smoothing sigma");
}

}  // namespace
}  // namespace darkling
