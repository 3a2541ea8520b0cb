// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <type_traits>

#include <gtest/gtest.h>

#include "base/image_view.h"

namespace darkling {
namespace {

TEST(ImageView, StepsFromRowToRowByItsStride) {
  std::array<int, 12> pixels{};
  for (int i = 0; i < 12; ++i) pixels[i] = i;
  const ImageView<int> view(pixels.data(), 3, 3, 4);
  EXPECT_EQ(view.at(0, 0), 0);
  EXPECT_EQ(view.at(2, 1), 6);
  EXPECT_EQ(view.row(2), pixels.data() + 8);
}

TEST(ImageView, WritesThroughToThePixels) {
  std::array<int, 4> pixels{};
  const ImageView<int> view(pixels.data(), 2, 2, 2);
  view.at(1, 1) = 9;
  EXPECT_EQ(pixels[3], 9);
}

TEST(ImageView, OfMutablePixelsReadsAsAViewOfConstantOnes) {
  std::array<int, 4> pixels = {1, 2, 3, 4};
  const ImageView<int> view(pixels.data(), 2, 2, 2);
  const ImageView<const int> constant = view;
  EXPECT_EQ(constant.at(1, 0), 2);
  EXPECT_TRUE(have_same_size(view, constant));
}

TEST(ImageView, OfConstantPixelsNeverBecomesMutable) {
  EXPECT_FALSE((std::is_convertible_v<ImageView<const int>, ImageView<int>>));
  EXPECT_FALSE((std::is_convertible_v<ImageView<int>, ImageView<const char>>));
}

TEST(ImageView, IsEmptyWithoutPixels) {
  int pixel = 0;
  EXPECT_TRUE(ImageView<int>().is_empty());
  EXPECT_TRUE(ImageView<int>(&pixel, 0, 1, 1).is_empty());
  EXPECT_FALSE(ImageView<int>(&pixel, 1, 1, 1).is_empty());
}

TEST(ImageView, ComparesSizesWithoutRegardToStride) {
  std::array<int, 8> pixels{};
  const ImageView<int> a(pixels.data(), 2, 2, 4);
  EXPECT_TRUE(have_same_size(a, ImageView<int>(pixels.data(), 2, 2, 2)));
  EXPECT_FALSE(have_same_size(a, ImageView<int>(pixels.data(), 2, 1, 2)));
  EXPECT_TRUE(a.has_size(2, 2));
  EXPECT_FALSE(a.has_size(4, 2));
}

}  // namespace
}  // namespace darkling
