// SPDX-License-Identifier: Apache-2.0
#include "kernels/census.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <sstream>
#include <vector>

#include "support/guarded_image.h"
#include "support/kernel_cases.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;

constexpr int kMaxWidth = 3 * 32 + 4;  // px, past three of the widest vectors

std::vector<std::uint8_t> pixels_of(const ImageView<const std::uint8_t>& image) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < image.height; ++y) {
    pixels.insert(pixels.end(), image.row(y), image.row(y) + image.width);
  }
  return pixels;
}

// The definition taken literally, one neighbour at a time, on a copy with a replicated border.
std::vector<std::uint8_t> census_oracle(const ImageView<const std::uint8_t>& image) {
  const int w = image.width;
  const int h = image.height;
  std::vector<std::vector<int>> bordered(h + 2, std::vector<int>(w + 2));
  for (int y = -1; y <= h; ++y) {
    for (int x = -1; x <= w; ++x) {
      bordered[y + 1][x + 1] = image.at(std::clamp(x, 0, w - 1), std::clamp(y, 0, h - 1));
    }
  }
  std::vector<std::uint8_t> codes(w * h, 0);
  int bit_value = 1;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      for (int i = 0; i < w * h; ++i) {
        const int x = i % w + 1;
        const int y = i / w + 1;
        if (bordered[y + dy][x + dx] - bordered[y][x] > 0) {
          codes[i] = static_cast<std::uint8_t>(codes[i] + bit_value);
        }
      }
      bit_value *= 2;
    }
  }
  return codes;
}

std::string describe(const GuardedLayout& layout, Fill fill) {
  std::ostringstream text;
  text << layout.width << "x" << layout.height << ", row padding " << layout.row_padding
       << ", distance to guard " << layout.distance_to_guard << ", fill " << test::name_of(fill);
  return text.str();
}

class EachCensus : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachCensus, EqualsTheOracleOnEveryShapeAndFill) {
  unsigned seed = 1;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    for (const Fill fill : test::kAllFills) {
      SCOPED_TRACE(describe(layout, fill));
      GuardedImage<std::uint8_t> src(layout);
      GuardedImage<std::uint8_t> dst(layout);
      test::fill_image(src.view(), fill, seed++);
      const std::vector<std::uint8_t> before = pixels_of(src.view());
      GetParam().census(src.view(), dst.view());
      ASSERT_EQ(pixels_of(dst.view()), census_oracle(src.view()));
      ASSERT_EQ(pixels_of(src.view()), before);
      ASSERT_TRUE(src.padding_is_untouched());
      ASSERT_TRUE(dst.padding_is_untouched());
    }
  });
}

TEST_P(EachCensus, EqualsTheReferenceBitForBit) {
  unsigned seed = 1000;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    for (const Fill fill : test::kAllFills) {
      SCOPED_TRACE(describe(layout, fill));
      GuardedImage<std::uint8_t> src(layout);
      // Another stride and start than the source: nothing may assume that they agree.
      GuardedImage<std::uint8_t> dst({.width = layout.width,
                                      .height = layout.height,
                                      .row_padding = layout.row_padding + 3,
                                      .distance_to_guard = 5});
      GuardedImage<std::uint8_t> expected(layout);
      test::fill_image(src.view(), fill, seed++);
      census_ref(src.view(), expected.view());
      GetParam().census(src.view(), dst.view());
      ASSERT_EQ(pixels_of(dst.view()), pixels_of(expected.view()));
    }
  });
}

TEST_P(EachCensus, IgnoresEveryStrictlyIncreasingGreyMap) {
  constexpr int kLevels = 100;
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<std::uint8_t> map(256);
    std::iota(map.begin(), map.end(), std::uint8_t{0});
    std::shuffle(map.begin(), map.end(), random);
    map.resize(kLevels);
    std::sort(map.begin(), map.end());  // `kLevels` different levels out of 256, in order

    const GuardedLayout layout = {.width = 71, .height = 9, .row_padding = 2};
    GuardedImage<std::uint8_t> plain(layout);
    GuardedImage<std::uint8_t> mapped(layout);
    for (int i = 0; i < layout.width * layout.height; ++i) {
      const int x = i % layout.width;
      const int y = i / layout.width;
      plain.view().at(x, y) = static_cast<std::uint8_t>(random() % kLevels);
      mapped.view().at(x, y) = map[plain.view().at(x, y)];
    }
    GuardedImage<std::uint8_t> plain_codes(layout);
    GuardedImage<std::uint8_t> mapped_codes(layout);
    GetParam().census(plain.view(), plain_codes.view());
    GetParam().census(mapped.view(), mapped_codes.view());
    ASSERT_EQ(pixels_of(plain_codes.view()), pixels_of(mapped_codes.view()));
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachCensus, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

TEST(Census, NumbersNeighboursInRasterOrder) {
  const std::uint8_t src[9] = {9, 1, 9,  //
                               1, 5, 9,  //
                               5, 9, 1};
  std::uint8_t dst[9] = {};
  census_ref({src, 3, 3, 3}, {dst, 3, 3, 3});
  EXPECT_EQ(dst[4], 0b0101'0101);  // 9 is greater than the centre; 1 and the equal 5 are not
}

TEST(Census, RefusesAnEmptyImage) {
  std::uint8_t pixel = 0;
  EXPECT_DEATH(census_ref({&pixel, 0, 1, 1}, {&pixel, 0, 1, 1}), "at least one pixel");
}

TEST(Census, RefusesADestinationOfAnotherSize) {
  const std::uint8_t src[4] = {};
  std::uint8_t dst[4] = {};
  EXPECT_DEATH(census_ref({src, 4, 1, 4}, {dst, 2, 2, 2}), "one code a pixel");
}

}  // namespace
}  // namespace darkling
