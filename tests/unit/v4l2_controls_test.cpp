// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/v4l2/camera_controls.h"
#include "support/fake_v4l2.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CameraControls : public ::testing::Test {
 protected:
  void SetUp() override {
    camera_.controls = {{V4L2_CID_EXPOSURE_AUTO, {.value = 1, .minimum = 0, .maximum = 3}},
                        {V4L2_CID_EXPOSURE_AUTO_PRIORITY, {.value = 1, .maximum = 1}},
                        {V4L2_CID_EXPOSURE_ABSOLUTE, {.value = 156, .minimum = 1, .maximum = 5000}},
                        {V4L2_CID_AUTOGAIN, {.value = 0, .maximum = 1}},
                        {V4L2_CID_GAIN, {.value = 16, .minimum = 16, .maximum = 255, .step = 4}}};
  }
  ExposureReading set() {
    set_exposure(device_, config_, milliseconds(50), remarks_);
    return read_exposure(device_);
  }
  int value(std::uint32_t id) { return camera_.controls.at(id).value; }

  FakeV4l2 system_;
  FakeV4l2Device& camera_ = system_.device("/dev/video0");
  DeviceDescriptor device_ = DeviceDescriptor::open(system_, "/dev/video0").value();
  CameraConfig config_;
  std::vector<std::string> remarks_;
};

TEST_F(CameraControls, LeaveExposureToTheCameraButNotTheFrameRate) {
  camera_.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 60;
  const ExposureReading reading = set();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_APERTURE_PRIORITY);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 0);
  EXPECT_EQ(value(V4L2_CID_AUTOGAIN), 1);
  EXPECT_EQ(reading.exposure_ms, 6.0);
  EXPECT_EQ(reading.gain, 16.0);
  EXPECT_THAT(remarks_, IsEmpty());
}

TEST_F(CameraControls, FallBackToTheFullAutomatic) {
  camera_.controls[V4L2_CID_EXPOSURE_AUTO].maximum = V4L2_EXPOSURE_MANUAL;
  set();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_AUTO);
}

TEST_F(CameraControls, SayWhenTheAutomaticExposesForLongerThanAllowed) {
  set();
  EXPECT_THAT(remarks_, ElementsAre(HasSubstr("exposes for 15.6 ms")));
}

TEST_F(CameraControls, SetAFixedExposureAndGain) {
  config_.exposure_ms = 4.26;
  config_.gain = 33.0;
  const ExposureReading reading = set();
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_AUTO_PRIORITY), 0);
  EXPECT_EQ(value(V4L2_CID_EXPOSURE_ABSOLUTE), 43);
  EXPECT_EQ(value(V4L2_CID_AUTOGAIN), 0);
  EXPECT_EQ(reading.exposure_ms, 4.3);
  EXPECT_EQ(reading.gain, 32.0);  // the nearest on its grid
  EXPECT_THAT(remarks_, IsEmpty());
}

TEST_F(CameraControls, HoldAFixedExposureBelowItsBoundAndThePeriod) {
  config_.exposure_ms = 30.0;
  EXPECT_EQ(set().exposure_ms, 10.0);
  EXPECT_THAT(remarks_, ElementsAre(HasSubstr("cut to 10 ms")));
  config_.exposure_ms = 80.0;
  config_.max_exposure_ms = 100.0;
  EXPECT_EQ(set().exposure_ms, 50.0);
}

TEST_F(CameraControls, StayInsideTheDevicesRange) {
  camera_.controls[V4L2_CID_GAIN].maximum = 254;  // off the grid of 16 + 4k
  config_.gain = 1000.0;
  EXPECT_EQ(set().gain, 252.0);
  config_.gain = 1.0;
  EXPECT_EQ(set().gain, 16.0);
}

TEST_F(CameraControls, UseTheAnalogueGainOfBareSensors) {
  camera_.controls.erase(V4L2_CID_GAIN);
  camera_.controls[V4L2_CID_ANALOGUE_GAIN] = {};
  config_.gain = 100.0;
  EXPECT_EQ(set().gain, 100.0);
}

TEST_F(CameraControls, MayAllBeMissing) {
  camera_.controls.clear();
  config_.exposure_ms = 5.0;
  config_.gain = 2.0;
  const ExposureReading reading = set();
  EXPECT_EQ(reading.exposure_ms, -1.0);
  EXPECT_EQ(reading.gain, -1.0);
  EXPECT_THAT(remarks_, ElementsAre(HasSubstr("no exposure time"), HasSubstr("no gain")));
}

TEST_F(CameraControls, ReadTheFrameRateBack) {
  EXPECT_EQ(set_frame_rate(device_, 20.0, remarks_), milliseconds(50));
  EXPECT_THAT(remarks_, IsEmpty());
}

TEST_F(CameraControls, SayWhenTheDeviceIsSlowerThanAskedAndGoOn) {
  camera_.shortest_period = milliseconds(40);
  EXPECT_EQ(set_frame_rate(device_, 30.0, remarks_), milliseconds(40));
  EXPECT_THAT(remarks_, Contains(HasSubstr("gives 25 frames a second, asked for were 30")));
}

TEST_F(CameraControls, SayWhenTheDeviceTakesNoFrameRate) {
  camera_.has_frame_rate = false;
  EXPECT_EQ(set_frame_rate(device_, 30.0, remarks_), Duration::zero());
  EXPECT_THAT(remarks_, ElementsAre(HasSubstr("takes no frame rate")));
}

}  // namespace
}  // namespace darkling::test
