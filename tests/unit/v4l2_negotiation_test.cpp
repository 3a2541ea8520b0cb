// SPDX-License-Identifier: Apache-2.0
#include <cerrno>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/v4l2/negotiate_format.h"
#include "support/fake_v4l2.h"

namespace darkling::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kPath = "/dev/video0";
constexpr ImageExtent kEye{32, 16};

class NegotiateFormat : public ::testing::Test {
 protected:
  void TearDown() override {
    EXPECT_EQ(system_.open_count(), 0);
    EXPECT_THAT(system_.violations(), IsEmpty());
  }

  Result<ImageFormat> negotiate(ImageExtent eye = kEye) {
    auto device = DeviceDescriptor::open(system_, kPath);
    if (!device) return tl::unexpected<Error>(device.error());
    return negotiate_format(*device, config_, eye);
  }
  std::string refusal() {
    const auto format = negotiate();
    if (format) return "";
    EXPECT_EQ(format.error().code, ExitCode::kDeviceUnavailable);
    EXPECT_THAT(format.error().message, HasSubstr(kPath));
    return format.error().message;
  }

  FakeV4l2 system_;
  FakeV4l2Device& camera_ = system_.device(kPath);
  CameraConfig config_;
};

TEST_F(NegotiateFormat, TakesTheFirstThatFitsInTheDriversOrderNotTheDevices) {
  camera_.formats = {{V4L2_PIX_FMT_YUYV, 32, 16, 64, 1024}, {V4L2_PIX_FMT_GREY, 32, 16, 40, 640}};
  const auto format = negotiate();
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->format, PixelFormat::kGrey);
  EXPECT_EQ(format->stride_bytes, 40);
  EXPECT_EQ(format->bytes, 15u * 40 + 32);
}

TEST_F(NegotiateFormat, PassesOverAFormatThatTheDeviceHasInOtherSizesOnly) {
  camera_.formats = {{V4L2_PIX_FMT_GREY, 64, 16, 64, 1024}, {V4L2_PIX_FMT_YUYV, 32, 16, 64, 1024}};
  EXPECT_EQ(negotiate().value().format, PixelFormat::kYuyv);
}

TEST_F(NegotiateFormat, TakesTheFormatThatIsAskedFor) {
  camera_.formats = {{V4L2_PIX_FMT_GREY, 32, 16, 32, 512}, {V4L2_PIX_FMT_UYVY, 32, 16, 64, 1024}};
  config_.format = PixelFormat::kUyvy;
  EXPECT_EQ(negotiate().value().format, PixelFormat::kUyvy);
}

TEST_F(NegotiateFormat, AsksForTheDoubleSizeOfBayer) {
  camera_.formats = {{V4L2_PIX_FMT_SGRBG8, 64, 32, 64, 2048}};
  const auto format = negotiate();
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->fourcc, static_cast<std::uint32_t>(V4L2_PIX_FMT_SGRBG8));
  EXPECT_EQ(format->extent, (ImageExtent{64, 32}));
}

TEST_F(NegotiateFormat, AsksForBothEyesOfASharedImage) {
  camera_.formats = {{V4L2_PIX_FMT_GREY, 64, 16, 64, 1024}, {V4L2_PIX_FMT_GREY, 32, 32, 32, 1024}};
  config_.layout = EyeLayout::kSideBySide;
  EXPECT_EQ(negotiate().value().extent, (ImageExtent{64, 16}));
  config_.layout = EyeLayout::kTopBottom;
  EXPECT_EQ(negotiate().value().extent, (ImageExtent{32, 32}));
}

TEST_F(NegotiateFormat, ComputesTheStrideThatADeviceDoesNotTell) {
  camera_.formats = {{V4L2_PIX_FMT_YUYV, 32, 16, 0, 1024}};
  EXPECT_EQ(negotiate().value().stride_bytes, 64);
}

TEST_F(NegotiateFormat, ListsWhatTheDeviceOffersWhenNothingFits) {
  camera_.formats = {{V4L2_PIX_FMT_H264, 32, 16, 0, 512}, {V4L2_PIX_FMT_GREY, 640, 480, 640, 1}};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("wanted: any at 32x16"),
                               HasSubstr("offers: H264 32x16, GREY 640x480")));
  camera_.formats.clear();
  EXPECT_THAT(refusal(), HasSubstr("offers: no format"));
}

TEST_F(NegotiateFormat, RefusesAConfiguredSizeThatDoesNotGiveTheCalibrationsEyes) {
  config_.width_px = 640;
  config_.height_px = 480;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("640x480"), HasSubstr("calibration's 32x16")));
}

TEST_F(NegotiateFormat, RefusesRowsThatAreTooShortOrAbsurd) {
  camera_.formats[0].stride_bytes = 31;
  EXPECT_THAT(refusal(), HasSubstr("no format fits"));
  camera_.formats[0].stride_bytes = 0xFFFFFFFF;
  EXPECT_THAT(refusal(), HasSubstr("no format fits"));
}

TEST_F(NegotiateFormat, RefusesNodesThatDoNotCaptureOrStream) {
  camera_.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_THAT(refusal(), HasSubstr("no video capture device"));
  camera_.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  EXPECT_THAT(refusal(), HasSubstr("multi-planar"));
  camera_.capabilities = V4L2_CAP_VIDEO_CAPTURE;
  EXPECT_THAT(refusal(), HasSubstr("does not stream"));
}

TEST_F(NegotiateFormat, SaysWhatKeepsTheDeviceFromUs) {
  camera_.open_error = EACCES;
  EXPECT_THAT(refusal(), HasSubstr("group video"));
  camera_.open_error = ENOENT;
  EXPECT_THAT(refusal(), HasSubstr("plugged in"));
  camera_.open_error = 0;
  camera_.errors[VIDIOC_S_FMT] = EBUSY;
  EXPECT_THAT(refusal(), HasSubstr("another program uses the camera"));
  camera_.errors = {{VIDIOC_QUERYCAP, ENOTTY}};
  EXPECT_THAT(refusal(), HasSubstr("no V4L2 device"));
}

}  // namespace
}  // namespace darkling::test
