// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "support/pixels.h"
#include "vo/measure_image.h"

namespace darkling {
namespace {

using test::GuardedImage;

// A slope of brightness with white noise on it.
void paint(double deviation, unsigned seed, const ImageView<std::uint8_t>& image) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, deviation);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double level = 90.0 + 0.2 * x + 0.1 * y + (deviation > 0.0 ? noise(random) : 0.0);
      image.at(x, y) = static_cast<std::uint8_t>(std::clamp(level + 0.5, 0.0, 255.0));
    }
  }
}

TEST(MeasureImage, FindsTheDeviationOfWhiteNoise) {
  GuardedImage<std::uint8_t> image({.width = 320, .height = 240});
  for (const double deviation : {1.0, 2.0, 5.0, 12.0, 30.0}) {
    paint(deviation, 3, image.view());
    EXPECT_NEAR(measure_image(image.view()).noise, deviation, 0.08 * deviation) << deviation;
  }
}

TEST(MeasureImage, FindsNextToNoneInASlope) {
  GuardedImage<std::uint8_t> image({.width = 320, .height = 240});
  paint(0.0, 0, image.view());
  EXPECT_LT(measure_image(image.view()).noise, 0.5);
}

TEST(MeasureImage, KnowsBlackAndWhiteAndOneImageFromAnother) {
  GuardedImage<std::uint8_t> image({.width = 64, .height = 48});
  test::fill_image(image.view(), test::Fill::kConstant, 3);
  const ImageMeasure black = measure_image(image.view());
  EXPECT_EQ(black.dark_share, 1.0);
  EXPECT_EQ(black.bright_share, 0.0);
  test::fill_image(image.view(), test::Fill::kConstant, 255);
  const ImageMeasure white = measure_image(image.view());
  EXPECT_EQ(white.dark_share, 0.0);
  EXPECT_EQ(white.bright_share, 1.0);
  EXPECT_NE(white.hash, black.hash);
  EXPECT_EQ(white.hash, measure_image(image.view()).hash);
}

TEST(MeasureImage, TakesTheSmallestImagesForFreeOfNoise) {
  for (const int size : {1, 2, 3}) {
    GuardedImage<std::uint8_t> image({.width = size, .height = size});
    test::fill_image(image.view(), test::Fill::kUniform, 1);
    EXPECT_GE(measure_image(image.view()).noise, 0.0) << size;
  }
}

TEST(DeadZone, GrowsWithTheNoiseAndIsNoneWithoutIt) {
  EXPECT_EQ(dead_zone_of(0.0), 0);
  EXPECT_EQ(dead_zone_of(0.8), 0);
  EXPECT_EQ(dead_zone_of(10.0), 6);
  EXPECT_EQ(dead_zone_of(20.0), 11);
  EXPECT_EQ(dead_zone_of(1000.0), 64);
}

}  // namespace
}  // namespace darkling
