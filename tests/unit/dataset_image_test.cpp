// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "drivers/dataset/read_image.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

const TinyDataset kTiny;

// The largest difference of grey level between what was read and what was written.
int largest_difference(const ImageBuffer& buffer, const GreyImage& written) {
  const auto image = buffer.image();
  if (!image.has_size(written.width, written.height)) return 256;
  int largest = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int difference = image.at(x, y) - written.pixels[y * written.width + x];
      largest = std::max(largest, std::abs(difference));
    }
  }
  return largest;
}

bool is_complete(const std::string& path) {
  const std::string content = read_text(path);
  const std::vector<std::uint8_t> bytes(content.begin(), content.end());
  return is_complete_image_file(bytes);
}

class DatasetImage : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string png_ = folder_ / "a.png";
  GreyImage tiny_ = tiny_image(kTiny, 0, false);
  ImageBuffer buffer_;
};

TEST_F(DatasetImage, IsReadAsItWasWritten) {
  write_image(png_, tiny_);
  ASSERT_TRUE(buffer_.read(png_));
  EXPECT_EQ(largest_difference(buffer_, tiny_), 0);
}

TEST_F(DatasetImage, KeepsTheUpperEightBitsOfSixteen) {
  write_image16(png_, tiny_);
  ASSERT_TRUE(buffer_.read(png_));
  EXPECT_EQ(largest_difference(buffer_, tiny_), 0);
}

TEST_F(DatasetImage, IsReadFromJpeg) {
  const std::string jpg = folder_ / "a.jpg";
  write_image(jpg, tiny_);
  ASSERT_TRUE(buffer_.read(jpg));
  EXPECT_LT(largest_difference(buffer_, tiny_), 40);
}

TEST_F(DatasetImage, TurnsColourIntoLuminance) {
  const cv::Mat colour(8, 8, CV_8UC3, cv::Scalar(255, 0, 0));  // blue
  ASSERT_TRUE(cv::imwrite(png_, colour));
  ASSERT_TRUE(buffer_.read(png_));
  EXPECT_NEAR(buffer_.image().at(4, 4), 0.114 * 255, 1.5);
}

TEST_F(DatasetImage, KeepsItsMemoryForImagesOfOneSize) {
  write_image(png_, tiny_);
  ASSERT_TRUE(buffer_.read(png_));
  const auto* pixels = buffer_.image().data;
  write_image(png_, tiny_image(kTiny, 1, false));
  ASSERT_TRUE(buffer_.read(png_));
  EXPECT_EQ(buffer_.image().data, pixels);
}

TEST_F(DatasetImage, IsNoneWhenTheFileIsAbsentEmptyOrAFolder) {
  EXPECT_FALSE(buffer_.read(folder_ / "absent.png"));
  write_text(png_, "");
  EXPECT_FALSE(buffer_.read(png_));
  EXPECT_FALSE(buffer_.read(folder_.path()));
}

TEST_F(DatasetImage, IsNoneWhenTheFileIsNoImage) {
  write_text(png_, "not found: 404");
  EXPECT_FALSE(buffer_.read(png_));
}

TEST_F(DatasetImage, IsNoneAtEveryLengthShortOfThePngsEnd) {
  write_image(png_, tiny_);
  const std::string whole = read_text(png_);
  ASSERT_TRUE(is_complete(png_));
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 97) {
    write_text(png_, whole.substr(0, length));
    EXPECT_FALSE(buffer_.read(png_)) << length << " of " << whole.size() << " bytes";
  }
  write_text(png_, whole.substr(0, whole.size() - 1));
  EXPECT_FALSE(buffer_.read(png_));
}

TEST_F(DatasetImage, IsNoneWhenAByteOfThePngChanged) {
  write_image(png_, tiny_);
  flip_middle_byte(png_);
  EXPECT_FALSE(buffer_.read(png_));
}

TEST_F(DatasetImage, IsNoneWhenTheJpegIsTruncated) {
  const std::string jpg = folder_ / "a.jpg";
  write_image(jpg, tiny_);
  ASSERT_TRUE(is_complete(jpg));
  truncate_file(jpg, 0.6);
  EXPECT_FALSE(buffer_.read(jpg));
}

TEST_F(DatasetImage, CanBeReadAfterOneThatCouldNot) {
  write_text(png_, "no image");
  EXPECT_FALSE(buffer_.read(png_));
  write_image(png_, tiny_);
  ASSERT_TRUE(buffer_.read(png_));
  EXPECT_EQ(largest_difference(buffer_, tiny_), 0);
}

TEST_F(DatasetImage, IsReadWithoutAWordOnTheTerminal) {
  write_image(png_, tiny_);
  truncate_file(png_, 0.5);
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(buffer_.read(png_));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace darkling::test
