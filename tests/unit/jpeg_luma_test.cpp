// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/jpeg_luma.h"

#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "support/jpeg_images.h"
#include "support/random.h"

namespace darkling::test {
namespace {

class DecodeJpeg : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_decode_jpeg()) GTEST_SKIP() << "built without libjpeg";
    luma_.emplace(kWidth);
  }
  bool decode(std::span<const std::uint8_t> jpeg, int width = kWidth, int height = kHeight) {
    pixels_.assign(static_cast<std::size_t>(width) * height, 0);
    return luma_->decode(jpeg, {pixels_.data(), width, height, width});
  }
  // As another program decodes it.
  [[nodiscard]] static std::vector<std::uint8_t> expected(const std::vector<std::uint8_t>& jpeg) {
    const cv::Mat image = cv::imdecode(jpeg, cv::IMREAD_GRAYSCALE);
    return {image.datastart, image.dataend};
  }

  static constexpr int kWidth = 70;  // no multiple of a block
  static constexpr int kHeight = 45;
  std::optional<JpegLuma> luma_;
  std::vector<std::uint8_t> pixels_;
};

TEST_F(DecodeJpeg, GivesTheLumaThatOpencvGives) {
  for (const bool is_colour : {false, true}) {
    for (const int quality : {20, 75, 100}) {
      const auto jpeg = jpeg_image(kWidth, kHeight, {.quality = quality, .is_colour = is_colour});
      ASSERT_TRUE(decode(jpeg)) << quality;
      EXPECT_EQ(pixels_, expected(jpeg)) << quality;
    }
  }
}

TEST_F(DecodeJpeg, WritesNoPixelBesideTheImage) {
  const auto jpeg = jpeg_image(kWidth, kHeight, {.is_colour = true});
  std::vector<std::uint8_t> wide(std::size_t{100} * kHeight, 77);
  ASSERT_TRUE(luma_->decode(jpeg, {wide.data(), kWidth, kHeight, 100}));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth; x < 100; ++x) ASSERT_EQ(wide[static_cast<std::size_t>(y) * 100 + x], 77);
  }
}

TEST_F(DecodeJpeg, HasTheUsualTablesWhereMotionJpegLeavesThemOut) {
  const auto jpeg = jpeg_image(kWidth, kHeight, {.is_colour = true});
  const auto bare = without_segments(jpeg, 0xC4);
  ASSERT_LT(bare.size() + 400, jpeg.size());
  ASSERT_TRUE(decode(bare));
  EXPECT_EQ(pixels_, expected(jpeg));
  EXPECT_FALSE(decode(without_segments(jpeg, 0xDB)));  // of quantisation there are no usual ones
}

TEST_F(DecodeJpeg, TakesNoTablesFromTheImageBefore) {
  const auto fine = jpeg_image(kWidth, kHeight, {.quality = 95, .has_best_tables = true});
  const auto bare = without_segments(jpeg_image(kWidth, kHeight, {.quality = 50}), 0xC4);
  ASSERT_TRUE(decode(bare));
  const auto pixels = pixels_;
  ASSERT_TRUE(decode(fine));
  ASSERT_TRUE(decode(bare));
  EXPECT_EQ(pixels_, pixels);
}

TEST_F(DecodeJpeg, PassesOverWhatCamerasLeaveBehindAndBetween) {
  auto jpeg = jpeg_image(kWidth, kHeight);
  const auto plain = expected(jpeg);
  jpeg.insert(jpeg.end(), 100, 0);
  jpeg.insert(jpeg.begin() + 2, 7, 0x11);
  ASSERT_TRUE(decode(jpeg));
  EXPECT_EQ(pixels_, plain);
}

TEST_F(DecodeJpeg, RefusesWhatIsCutShortAnywhere) {
  const auto jpeg = jpeg_image(kWidth, kHeight, {.is_colour = true});
  for (std::size_t size = 0; size + 2 < jpeg.size(); ++size) {
    ASSERT_FALSE(decode(std::span(jpeg).first(size))) << size << " of " << jpeg.size();
  }
  EXPECT_TRUE(decode(jpeg));
}

TEST_F(DecodeJpeg, RefusesAnotherSize) {
  const auto jpeg = jpeg_image(kWidth, kHeight);
  EXPECT_FALSE(decode(jpeg, kWidth - 1));
  EXPECT_FALSE(decode(jpeg, kWidth, kHeight + 1));
  EXPECT_FALSE(decode(jpeg_image(8 * kWidth, kHeight)));
  EXPECT_TRUE(decode(jpeg));
}

TEST_F(DecodeJpeg, RefusesImagesThatComeInSeveralScans) {
  EXPECT_FALSE(decode(jpeg_image(kWidth, kHeight, {.is_progressive = true})));
  EXPECT_TRUE(decode(jpeg_image(kWidth, kHeight)));
}

TEST_F(DecodeJpeg, SurvivesAnythingAndDecodesTheNext) {
  Random random(7);
  const auto sound = jpeg_image(kWidth, kHeight, {.is_colour = true});
  const auto pixels = expected(sound);
  int refused = 0;
  for (int round = 0; round < 5000; ++round) {
    auto jpeg = sound;
    for (int i = random.integer(0, 5); i >= 0; --i) {
      const auto at = static_cast<std::size_t>(random.integer(2, 700));
      jpeg[at % jpeg.size()] = static_cast<std::uint8_t>(random.integer(0, 255));
    }
    refused += decode(jpeg) ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_FALSE(decode(std::vector<std::uint8_t>(5000, 0xFF)));
  ASSERT_TRUE(decode(sound));
  EXPECT_EQ(pixels_, pixels);
}

}  // namespace
}  // namespace darkling::test
