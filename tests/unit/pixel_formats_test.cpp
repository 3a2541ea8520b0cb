// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/pixel_formats.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "support/random.h"

namespace darkling::test {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kPadding = 0xA5;

// The rows of `source`, `stride` bytes each, as grey; what lies around the grey image stays.
Bytes grey_of(PixelFormat format, const Bytes& source, std::ptrdiff_t stride, ImageExtent grey) {
  const int pitch = grey.width + 3;
  Bytes target(static_cast<std::size_t>(pitch) * grey.height, kPadding);
  to_grey(format, source.data(), stride, {target.data(), grey.width, grey.height, pitch});
  Bytes packed;
  for (int y = 0; y < grey.height; ++y) {
    const auto row = target.begin() + static_cast<std::ptrdiff_t>(y) * pitch;
    packed.insert(packed.end(), row, row + grey.width);
    EXPECT_TRUE(std::all_of(row + grey.width, row + pitch,
                            [](std::uint8_t byte) { return byte == kPadding; }));
  }
  return packed;
}

TEST(PixelFormats, TakesGreyAsItIsAndLeavesThePaddingOut) {
  EXPECT_THAT(grey_of(PixelFormat::kGrey, {1, 2, 3, 99, 4, 5, 6}, 4, {3, 2}),
              ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(PixelFormats, TakesTheUpperEightOfTenTwelveAndSixteenBits) {
  const Bytes words = {0x00, 0x00, 0xFF, 0x03, 0x04, 0x00, 0xFF, 0x01};
  EXPECT_THAT(grey_of(PixelFormat::kY10, words, 8, {4, 1}), ElementsAre(0, 255, 1, 127));
  const Bytes deep = {0x00, 0x08, 0xFF, 0x0F, 0x10, 0x00};
  EXPECT_THAT(grey_of(PixelFormat::kY12, deep, 6, {3, 1}), ElementsAre(128, 255, 1));
  const Bytes full = {0xFF, 0x00, 0x00, 0x01, 0xFF, 0xFF};
  EXPECT_THAT(grey_of(PixelFormat::kY16, full, 6, {3, 1}), ElementsAre(0, 1, 255));
}

TEST(PixelFormats, WeighsColoursAsTheEyeDoesAndKeepsWhite) {
  const Bytes rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 10, 10, 10};
  EXPECT_THAT(grey_of(PixelFormat::kRgb, rgb, 15, {5, 1}), ElementsAre(77, 149, 29, 255, 10));
  EXPECT_THAT(grey_of(PixelFormat::kBgr, rgb, 15, {5, 1}), ElementsAre(29, 149, 77, 255, 10));
  EXPECT_EQ(row_bytes(PixelFormat::kRgb, 7), 21);
}

TEST(PixelFormats, TakesValuesAboveTheirDepthForWhite) {
  EXPECT_THAT(grey_of(PixelFormat::kY10, {0x00, 0x04, 0xFF, 0xFF}, 4, {2, 1}),
              ElementsAre(255, 255));
  EXPECT_THAT(grey_of(PixelFormat::kY12, {0x00, 0x10}, 2, {1, 1}), ElementsAre(255));
}

TEST(PixelFormats, UnpacksFivesOfBytesAlsoWhenTheLastIsNotFull) {
  const Bytes packed = {10, 20, 30, 40, 0xFF, 50, 60, 70, 99, 99, 11, 21, 31, 41, 0, 51, 61, 71};
  EXPECT_THAT(grey_of(PixelFormat::kY10P, packed, 10, {7, 2}),
              ElementsAre(10, 20, 30, 40, 50, 60, 70, 11, 21, 31, 41, 51, 61, 71));
}

TEST(PixelFormats, TakesTheLumaOfYuyvAndUyvyAlsoOfOddWidths) {
  const Bytes bytes = {1, 101, 2, 102, 3, 103, 4, 104};
  EXPECT_THAT(grey_of(PixelFormat::kYuyv, bytes, 8, {3, 1}), ElementsAre(1, 2, 3));
  EXPECT_THAT(grey_of(PixelFormat::kUyvy, bytes, 8, {3, 1}), ElementsAre(101, 102, 103));
}

TEST(PixelFormats, TakesTheFirstPlaneOfNv12) {
  const Bytes planes = {1, 2, 3, 4, 128, 128};
  EXPECT_THAT(grey_of(PixelFormat::kNv12, planes, 2, {2, 2}), ElementsAre(1, 2, 3, 4));
}

TEST(PixelFormats, AveragesBayerCellsRoundedAndDropsAnOddRowAndColumn) {
  // 5x3 with a byte of padding a row: two cells.
  const Bytes mosaic = {0,  1,  10, 20, 99, 77,  //
                        1,  0,  30, 41, 99, 77,  //
                        99, 99, 99, 99, 99, 77};
  const ImageExtent grey = grey_extent(PixelFormat::kBayer, {5, 3});
  EXPECT_EQ(grey, (ImageExtent{2, 1}));
  EXPECT_THAT(grey_of(PixelFormat::kBayer, mosaic, 6, grey), ElementsAre(1, 25));
  const Bytes white(4, 255);
  EXPECT_THAT(grey_of(PixelFormat::kBayer, white, 2, {1, 1}), ElementsAre(255));
}

TEST(PixelFormats, SaysHowManyBytesARowHolds) {
  EXPECT_EQ(row_bytes(PixelFormat::kGrey, 7), 7);
  EXPECT_EQ(row_bytes(PixelFormat::kNv12, 7), 7);
  EXPECT_EQ(row_bytes(PixelFormat::kBayer, 7), 7);
  EXPECT_EQ(row_bytes(PixelFormat::kY10, 7), 14);
  EXPECT_EQ(row_bytes(PixelFormat::kY10P, 8), 10);
  EXPECT_EQ(row_bytes(PixelFormat::kY10P, 5), 7);
  EXPECT_EQ(row_bytes(PixelFormat::kYuyv, 8), 16);
  EXPECT_EQ(row_bytes(PixelFormat::kUyvy, 7), 14);
}

TEST(PixelFormats, DoesNotAskForPaddingBehindTheLastRow) {
  EXPECT_EQ(image_bytes(PixelFormat::kGrey, {30, 10}, 32), 9u * 32 + 30);
  EXPECT_EQ(image_bytes(PixelFormat::kGrey, {0, 10}, 32), 0u);
}

// A sanitizer sees what is read beyond the vector's end.
TEST(PixelFormats, ReadsNoByteBehindTheImage) {
  Random random(7);
  for (const PixelFormat format : kPixelFormats) {
    if (is_compressed(format)) continue;  // jpeg_luma_test.cpp
    for (int i = 0; i < 50; ++i) {
      const ImageExtent extent{random.integer(1, 33), random.integer(1, 9)};
      const std::ptrdiff_t stride = row_bytes(format, extent.width) + random.integer(0, 5);
      const Bytes source(image_bytes(format, extent, stride), 255);
      const ImageExtent grey = grey_extent(format, extent);
      const Bytes white(static_cast<std::size_t>(grey.width) * grey.height, 255);
      EXPECT_EQ(grey_of(format, source, stride, grey), white) << pixel_format_name(format);
    }
  }
}

TEST(PixelFormats, FindsEveryFormatByItsCodes) {
  for (const PixelFormat format : kPixelFormats) {
    ASSERT_FALSE(fourccs_of(format).empty());
    for (const std::uint32_t fourcc : fourccs_of(format)) {
      EXPECT_EQ(pixel_format_of(fourcc), format) << fourcc_text(fourcc);
    }
  }
  EXPECT_EQ(fourccs_of(PixelFormat::kBayer).size(), 4u);
  EXPECT_TRUE(fourccs_of(PixelFormat::kAny).empty());
  EXPECT_FALSE(pixel_format_of(V4L2_PIX_FMT_H264).has_value());
  EXPECT_FALSE(pixel_format_of(0).has_value());
}

TEST(PixelFormats, NamesFormatsAndCodes) {
  EXPECT_STREQ(pixel_format_name(PixelFormat::kY10P), "y10p");
  EXPECT_STREQ(pixel_format_name(PixelFormat::kAny), "any");
  EXPECT_EQ(fourcc_text(V4L2_PIX_FMT_YUYV), "YUYV");
  EXPECT_EQ(fourcc_text(0x01424142), "BAB?");
}

}  // namespace
}  // namespace darkling::test
