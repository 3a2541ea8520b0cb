// SPDX-License-Identifier: Apache-2.0
// Cameras that send JPEG images.
#include <algorithm>

#include "drivers/camera/jpeg_luma.h"
#include "support/jpeg_images.h"
#include "support/two_cameras.h"

namespace darkling::test {
namespace {

class MjpegCameras : public TwoCameras {
 protected:
  static constexpr std::uint32_t kMostBytes = 4096;

  void SetUp() override {
    if (!can_decode_jpeg()) GTEST_SKIP() << "built without libjpeg";
    for (FakeV4l2Device* camera : {&left_, &right_}) {
      camera->formats = {{V4L2_PIX_FMT_MJPEG, 32, 16, 0, kMostBytes}};
      camera->paint = [this](std::uint32_t sequence, std::uint8_t* bytes) {
        const auto jpeg = jpeg_of(static_cast<int>(sequence));
        std::ranges::copy(jpeg, bytes);
        return jpeg.size();
      };
    }
  }
  [[nodiscard]] std::vector<std::uint8_t> jpeg_of(int sequence) const {
    return jpeg_image(width_, 16, {.is_colour = true, .seed = sequence});
  }
  // Spoils what the camera sends as frame 1.
  static void spoil(FakeV4l2Device& camera,
                    const std::function<std::size_t(std::uint8_t*, std::size_t)>& change) {
    const auto sound = camera.paint;
    camera.paint = [=](std::uint32_t sequence, std::uint8_t* bytes) {
      const std::size_t size = sound(sequence, bytes);
      return sequence == 1 ? change(bytes, size) : size;
    };
  }
  void expect_image(const ImageView<const std::uint8_t>& image, int sequence, int first) {
    std::vector<std::uint8_t> luma(static_cast<std::size_t>(width_) * 16);
    ASSERT_TRUE(JpegLuma(width_).decode(jpeg_of(sequence), {luma.data(), width_, 16, width_}));
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 32; ++x) {
        ASSERT_EQ(image.at(x, y), luma[static_cast<std::size_t>(y) * width_ + first + x]);
      }
    }
  }
  void expect_one_unreadable_pair() {
    EXPECT_EQ(next_sequence(), 0);
    const WaitResult bad = next();
    EXPECT_EQ(bad.status, WaitStatus::kBadFrame);
    EXPECT_EQ(bad.fault, FrameFault::kUnreadable);
    EXPECT_EQ(bad.sequence, 1);
    for (int k = 2; k < 12; ++k) EXPECT_EQ(next_sequence(), k);  // no buffer was lost
    EXPECT_EQ(source_->stats().unreadable, 1);
    EXPECT_EQ(source_->stats().delivered, 11);
  }

  int width_ = 32;
};

TEST_F(MjpegCameras, AreDecodedAndKeepTheirBuffers) {
  start();
  std::vector<WaitResult> held;
  for (int k = 0; k < 3; ++k) {
    held.push_back(next());
    ASSERT_EQ(held.back().status, WaitStatus::kFrame);
    expect_image(held.back().lease.frame().left, k, 0);
    expect_image(held.back().lease.frame().right, k, 0);
  }
}

TEST_F(MjpegCameras, MayShowBothEyesInAnImage) {
  config_.source = "v4l2:/dev/video0";
  config_.layout = EyeLayout::kSideBySide;
  left_.formats = {{V4L2_PIX_FMT_MJPEG, 64, 16, 0, kMostBytes}};
  width_ = 64;
  start();
  const WaitResult result = next();
  ASSERT_EQ(result.status, WaitStatus::kFrame);
  expect_image(result.lease.frame().left, 0, 0);
  expect_image(result.lease.frame().right, 0, 32);
}

TEST_F(MjpegCameras, AreTheLastChoice) {
  left_.formats.push_back({V4L2_PIX_FMT_YUYV, 32, 16, 64, 1024});
  left_.paint = nullptr;
  start();
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(left_.format().fourcc, std::uint32_t{V4L2_PIX_FMT_YUYV});
}

TEST_F(MjpegCameras, LoseAPairWithAnImageThatIsCutShort) {
  spoil(left_, [](std::uint8_t*, std::size_t size) { return size / 2; });
  start();
  expect_one_unreadable_pair();
}

TEST_F(MjpegCameras, LoseAPairWithAnImageOfAnotherSizeOfTheOtherEye) {
  spoil(right_, [](std::uint8_t* bytes, std::size_t) {
    const auto other = jpeg_image(48, 16);
    std::ranges::copy(other, bytes);
    return other.size();
  });
  start();
  expect_one_unreadable_pair();
}

TEST_F(MjpegCameras, GiveTheOtherEyesBufferBackWhereItWasShownInPlace) {
  left_.formats = {FakeFormat()};
  left_.paint = nullptr;
  spoil(right_, [](std::uint8_t* bytes, std::size_t size) {
    std::fill_n(bytes, size, std::uint8_t{0xFF});
    return size;
  });
  start();
  expect_one_unreadable_pair();
}

TEST_F(MjpegCameras, AreNotReadBeyondTheirBuffer) {
  left_.alter = [](v4l2_buffer& buffer) {
    if (buffer.sequence == 1) buffer.bytesused = 0x7FFFFFFF;  // a sanitizer sees what is read
  };
  start();
  EXPECT_EQ(next_sequence(), 0);
  EXPECT_EQ(next_sequence(), 1);  // what is behind the image does not matter
}

TEST_F(MjpegCameras, LoseASharedPairWithGarbage) {
  config_.source = "v4l2:/dev/video0";
  config_.layout = EyeLayout::kSideBySide;
  left_.formats = {{V4L2_PIX_FMT_MJPEG, 64, 16, 0, kMostBytes}};
  width_ = 64;
  spoil(left_, [](std::uint8_t* bytes, std::size_t size) {
    std::fill_n(bytes + 2, size - 2, std::uint8_t{0xD8});
    return size;
  });
  start();
  expect_one_unreadable_pair();
}

}  // namespace
}  // namespace darkling::test
