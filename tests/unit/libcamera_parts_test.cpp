// SPDX-License-Identifier: Apache-2.0
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/camera/pixel_formats.h"
#include "drivers/libcamera/control_plan.h"
#include "drivers/libcamera/drm_formats.h"
#include "drivers/libcamera/libcamera_source.h"
#include "drivers/libcamera/libcamera_spec.h"
#include "drivers/libcamera/sensor_stamp.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;

TEST(ParseLibcamera, TakesOneCameraOrTwo) {
  EXPECT_THAT(parse_libcamera("libcamera:platform/vimc.0 Sensor B").value(),
              ElementsAre("platform/vimc.0 Sensor B"));
  EXPECT_THAT(parse_libcamera("libcamera:0,1").value(), ElementsAre("0", "1"));
}

TEST(ParseLibcamera, RefusesWhatMakesNoRig) {
  for (const char* text : {"libcamera:", "libcamera:0,", "libcamera:,0", "libcamera:0,1,2",
                           "libcamera:0,0", "v4l2:0"}) {
    const auto names = parse_libcamera(text);
    ASSERT_FALSE(names.has_value()) << text;
    EXPECT_EQ(names.error().code, ExitCode::kUsage);
    EXPECT_THAT(names.error().message, HasSubstr("allowed: libcamera:ID"));
  }
}

TEST(FindCamera, TakesTheIdentifierAnEndOfItOrItsPlace) {
  const std::vector<std::string> ids = {"/soc/a/cam@10", "/soc/b/cam@10", "/soc/b/cam@20"};
  EXPECT_EQ(find_camera("/soc/b/cam@10", ids).value(), "/soc/b/cam@10");
  EXPECT_EQ(find_camera("b/cam@10", ids).value(), "/soc/b/cam@10");
  EXPECT_EQ(find_camera("@20", ids).value(), "/soc/b/cam@20");
  EXPECT_EQ(find_camera("0", ids).value(), "/soc/a/cam@10");
  EXPECT_EQ(find_camera("2", ids).value(), "/soc/b/cam@20");
  EXPECT_THAT(find_camera("cam@10", ids).error().message, HasSubstr("several end so"));
  EXPECT_THAT(find_camera("7", ids).error().message, HasSubstr("1 \"/soc/b/cam@10\""));
  EXPECT_THAT(find_camera("x", {}).error().message, HasSubstr("libcamera sees no camera"));
}

CompletedFrame stamped(Duration stamp) {
  CompletedFrame frame;
  frame.stamp_ns = stamp.count();
  frame.is_of_sensor = true;
  frame.arrival = MonotonicTime{milliseconds(1000)};
  return frame;
}

Duration middle(const CompletedFrame& frame, Duration boot_ahead, double exposure_ms) {
  return stamp_frame(frame, boot_ahead, exposure_ms).middle.time_since_epoch();
}

TEST(StampFrame, GoesFromTheStartOfTheExposureToItsMiddle) {
  EXPECT_EQ(middle(stamped(milliseconds(970)), Duration::zero(), 10.0), milliseconds(975));
  EXPECT_EQ(middle(stamped(milliseconds(970)), Duration::zero(), -1.0), milliseconds(970));
}

TEST(StampFrame, GoesBackToTheMiddleFromTheStampOfTheBuffer) {
  CompletedFrame frame = stamped(milliseconds(970));
  frame.is_of_sensor = false;
  const SensorStamp stamp = stamp_frame(frame, Duration::zero(), 10.0);
  EXPECT_EQ(stamp.middle.time_since_epoch(), milliseconds(965));
  EXPECT_EQ(stamp.source, StampSource::kEndOfFrame);
}

TEST(StampFrame, TellsTheTwoClocksApartAfterASuspension) {
  const Duration ahead = std::chrono::hours(3);
  EXPECT_EQ(middle(stamped(milliseconds(970)), ahead, 0.0), milliseconds(970));
  EXPECT_EQ(middle(stamped(milliseconds(970) + ahead), ahead, 0.0), milliseconds(970));
}

TEST(StampFrame, TakesTheArrivalForWhatMakesNoSense) {
  for (const Duration stamp : {Duration::zero(), Duration{-5}, Duration::max(),
                               Duration(milliseconds(1002)), Duration(std::chrono::hours(9))}) {
    const SensorStamp made = stamp_frame(stamped(stamp), Duration::zero(), 10.0);
    EXPECT_EQ(made.source, StampSource::kArrival);
    EXPECT_EQ(made.middle.time_since_epoch(), milliseconds(995));
  }
}

TEST(StampFrame, TellsTheFutureFromWantOfAStamp) {
  for (const Duration stamp :
       {Duration(milliseconds(1002)), Duration(std::chrono::hours(9)), Duration::max()}) {
    EXPECT_TRUE(stamp_frame(stamped(stamp), Duration::zero(), 10.0).is_of_future);
  }
  for (const Duration stamp : {Duration::zero(), Duration{-5}, Duration(milliseconds(1001))}) {
    EXPECT_FALSE(stamp_frame(stamped(stamp), Duration::zero(), 10.0).is_of_future);
  }
}

TEST(StampFrame, IsOffByAnExposureOrAPeriodAtMost) {
  using enum StampSource;
  const Duration period = milliseconds(50);
  EXPECT_EQ(sensor_stamp_uncertainty(kStartOfExposure, 8.0, period), milliseconds(8));
  EXPECT_EQ(sensor_stamp_uncertainty(kStartOfExposure, -1.0, period), period);
  EXPECT_EQ(sensor_stamp_uncertainty(kEndOfFrame, 8.0, period), period);
  EXPECT_EQ(sensor_stamp_uncertainty(kArrival, 8.0, period), Duration::zero());
}

constexpr ControlRange kExposures_us = {.least = 20.0, .most = 100'000.0};
constexpr ControlRange kGains = {.least = 1.0, .most = 16.0};
constexpr ControlRange kPeriods_us = {.least = 16'000.0, .most = 200'000.0};
const CameraControls kAll = {
    .has_automatic = true, .exposure_us = kExposures_us, .gain = kGains, .period_us = kPeriods_us};

TEST(PlanControls, HoldsTheRateWithAnAutomaticExposureAndSaysWhatBoundsIt) {
  CameraConfig config;
  const ControlPlan plan = plan_controls("cam", config, kAll);
  EXPECT_THAT(plan.is_automatic, Optional(true));
  EXPECT_THAT(plan.period_us, Optional(50'000));
  EXPECT_FALSE(plan.exposure_us.has_value());
  EXPECT_FALSE(plan.gain.has_value());
  EXPECT_THAT(plan.remarks, ElementsAre(HasSubstr("bounded by the frame's period")));
  config.max_exposure_ms = 50.0;
  EXPECT_THAT(plan_controls("cam", config, kAll).remarks, IsEmpty());
}

TEST(PlanControls, SwitchesTheAutomaticOffOnlyWhenNothingIsLeftToIt) {
  CameraConfig config;
  config.exposure_ms = 8.0;
  EXPECT_THAT(plan_controls("cam", config, kAll).is_automatic, Optional(true));
  config.gain = 40.0;
  const ControlPlan plan = plan_controls("cam", config, kAll);
  EXPECT_THAT(plan.is_automatic, Optional(false));
  EXPECT_THAT(plan.exposure_us, Optional(8000));
  EXPECT_THAT(plan.gain, Optional(16.0F));
  EXPECT_THAT(plan.remarks, IsEmpty());
}

TEST(PlanControls, CutsAFixedExposureToTheLongestAndThePeriod) {
  CameraConfig config;
  config.exposure_ms = 90.0;
  EXPECT_THAT(plan_controls("cam", config, kAll).exposure_us, Optional(10'000));
  config.max_exposure_ms = 80.0;
  const ControlPlan plan = plan_controls("cam", config, kAll);
  EXPECT_THAT(plan.exposure_us, Optional(50'000));
  EXPECT_THAT(plan.remarks, ElementsAre(HasSubstr("cut to 50 ms")));
}

TEST(PlanControls, SetsNothingThatACameraLacksAndSaysSo) {
  CameraConfig config;
  config.exposure_ms = 8.0;
  config.gain = 2.0;
  const ControlPlan plan = plan_controls("cam", config, {});
  EXPECT_FALSE(plan.is_automatic || plan.exposure_us || plan.gain || plan.period_us);
  EXPECT_THAT(plan.remarks, ElementsAre(HasSubstr("no frame rate"), HasSubstr("no exposure time"),
                                        HasSubstr("no gain")));
  config.rate_hz = 100.0;
  EXPECT_THAT(plan_controls("cam", config, kAll).remarks,
              ElementsAre(HasSubstr("gives 62.5 frames a second")));
}

TEST(DrmFormats, AreDifferentAndThoseWithoutACopyComeFirst) {
  std::set<std::pair<std::uint32_t, std::uint64_t>> seen;
  bool is_copied = false;
  for (const DrmFormat& format : drm_formats()) {
    EXPECT_TRUE(seen.insert({format.fourcc, format.modifier}).second);
    EXPECT_NE(format.format, PixelFormat::kAny);
    EXPECT_FALSE(is_copied && is_grey_in_place(format.format));
    is_copied = is_copied || !is_grey_in_place(format.format);
  }
}

TEST(CreateLibcameraSource, FindsTheLibraryOrSaysThatThereIsNone) {
  CameraConfig config;
  config.source = "libcamera:no such camera";
  config.layout = EyeLayout::kSideBySide;
  const auto source = create_libcamera_source(config, {.width = 320, .height = 240});
#ifdef DARKLING_HAS_LIBCAMERA
  ASSERT_TRUE(source) << source.error().message;
  for (int round = 0; round < 2; ++round) {
    const auto started = (*source)->start();
    ASSERT_FALSE(started.has_value());
    EXPECT_EQ(started.error().code, ExitCode::kDeviceUnavailable);
    EXPECT_THAT(started.error().message, HasSubstr("there is none; libcamera sees"));
  }
#else
  ASSERT_FALSE(source.has_value());
  EXPECT_EQ(source.error().code, ExitCode::kConfiguration);
  EXPECT_THAT(source.error().message, HasSubstr("built without libcamera"));
#endif
}

TEST(CreateLibcameraSource, RefusesALayoutThatDoesNotFit) {
  CameraConfig config;
  config.source = "libcamera:0";
  const auto source = create_libcamera_source(config, {.width = 320, .height = 240});
  ASSERT_FALSE(source.has_value());
  EXPECT_EQ(source.error().code, ExitCode::kConfiguration);
}

}  // namespace
}  // namespace darkling::test
