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

TEST(MeasureImage, KnowsBlackAndWhite) {
  GuardedImage<std::uint8_t> image({.width = 64, .height = 48});
  test::fill_image(image.view(), test::Fill::kConstant, 3);
  const ImageMeasure black = measure_image(image.view());
  EXPECT_EQ(black.dark_share, 1.0);
  EXPECT_EQ(black.bright_share, 0.0);
  test::fill_image(image.view(), test::Fill::kConstant, 255);
  const ImageMeasure white = measure_image(image.view());
  EXPECT_EQ(white.dark_share, 0.0);
  EXPECT_EQ(white.bright_share, 1.0);
}

TEST(MeasureImage, TellsSharpEdgesFromSmearedOnesAlongEachAxis) {
  GuardedImage<std::uint8_t> image({.width = 128, .height = 96});
  // Stripes of 16 px, along x with an edge that is `width` px wide, along y with sharp ones.
  const auto sharpness_of = [&image](int width) {
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 128; ++x) {
        const int along_x = std::min(x % 16, width) * 60 / width;
        image.view().at(x, y) = static_cast<std::uint8_t>(40 + along_x + (y / 16 % 2) * 60);
      }
    }
    return measure_sharpness(image.view(), 0.0);
  };
  const auto sharp = sharpness_of(1);
  const auto smeared = sharpness_of(8);
  EXPECT_GT(sharp[0], 2.0 * smeared[0]);
  EXPECT_NEAR(sharp[1], smeared[1], 0.1 * sharp[1]);
}

TEST(MeasureImage, KnowsNoSharpnessOfNoiseAndOfNothing) {
  GuardedImage<std::uint8_t> image({.width = 128, .height = 96});
  test::fill_image(image.view(), test::Fill::kConstant, 90);
  EXPECT_EQ(measure_sharpness(image.view(), 1.0)[0], 0.0);
  test::fill_image(image.view(), test::Fill::kUniform, 1);
  EXPECT_EQ(measure_sharpness(image.view(), measure_image(image.view()).noise)[0], 0.0);
}

TEST(Repetition, IsOfAllOrOfRowsAndNotOfWhatIsPlain) {
  GuardedImage<std::uint8_t> image({.width = 128, .height = 96});
  test::fill_image(image.view(), test::Fill::kUniform, 1);
  const ImageMeasure first = measure_image(image.view());
  EXPECT_TRUE(repetition_of(measure_image(image.view()), first).is_whole);
  EXPECT_FALSE(repetition_of(measure_image(image.view()), first).is_partial);

  for (int y = 0; y < 40; ++y) image.view().row(y)[64] ^= 1;
  const Repetition lower = repetition_of(measure_image(image.view()), first);
  EXPECT_TRUE(lower.is_partial);
  EXPECT_FALSE(lower.is_whole);

  for (int y = 40; y < 96; ++y) std::fill_n(image.view().row(y), 128, 255);
  const ImageMeasure with_sky = measure_image(image.view());
  for (int y = 0; y < 40; ++y) image.view().row(y)[64] ^= 1;
  EXPECT_FALSE(repetition_of(measure_image(image.view()), with_sky).is_partial);
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
