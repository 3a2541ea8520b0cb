// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace darkling::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ParseV4l2, TakesOneDeviceOrTwo) {
  EXPECT_THAT(parse_v4l2("v4l2:/dev/video0").value(), ElementsAre("/dev/video0"));
  EXPECT_THAT(parse_v4l2("v4l2:/dev/video0,/dev/v4l/by-path/pci-0:1").value(),
              ElementsAre("/dev/video0", "/dev/v4l/by-path/pci-0:1"));
}

void expect_refused(std::string_view text, std::string_view reason) {
  const auto parsed = parse_v4l2(text);
  ASSERT_FALSE(parsed.has_value()) << text;
  EXPECT_EQ(parsed.error().code, ExitCode::kUsage);
  EXPECT_THAT(parsed.error().message, HasSubstr(std::string(reason)));
  EXPECT_THAT(parsed.error().message, HasSubstr("allowed: v4l2:/dev/videoN"));
}

TEST(ParseV4l2, RefusesWhatNamesNoDevice) {
  expect_refused("", "no V4L2 source");
  expect_refused("/dev/video0", "no V4L2 source");
  expect_refused("v4l2:", "a device is missing");
  expect_refused("v4l2:/dev/video0,", "a device is missing");
  expect_refused("v4l2:,/dev/video0", "a device is missing");
  expect_refused("v4l2:video0", "\"video0\" is no absolute path");
}

TEST(ParseV4l2, RefusesThreeEyesAndTheSameEyeTwice) {
  expect_refused("v4l2:/dev/video0,/dev/video1,/dev/video2", "3 devices are named");
  expect_refused("v4l2:/dev/video0,/dev/video0", "the same device");
}

}  // namespace
}  // namespace darkling::test
