// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/top/attitude.h"
#include "app/top/lay_out.h"
#include "app/top/sections.h"
#include "support/message_cases.h"

namespace darkling {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr MonotonicTime kStart{std::chrono::seconds(100)};

status_t good_status() {
  status_t status = {};
  status.state = status_t::STATE_TRACKING;
  status.uptime_s = 3723.4;
  status.frames_in = 74468;
  status.frames_tracked = 74460;
  status.rate_in_hz = status.rate_out_hz = 20.0;
  status.latency_p50_ms = 12.34;
  status.latency_max_ms = 20.1;
  status.exposure_ms = status.gain = -1.0;
  status.stamp_source = status_t::STAMP_START_OF_EXPOSURE;
  status.rss_bytes = 45'600'000;
  status.width = 160;
  status.height = 120;
  status.kernels = "avx2";
  status.version = "0.1.0";
  status.camera = "v4l2:/dev/video0,/dev/video1";
  return status;
}

pose_t good_pose() {
  pose_t pose = {};
  pose.status = pose_t::STATUS_VALID;
  pose.quality = 72;
  pose.translation[0] = 12.345;
  pose.rotation[0] = pose.rotation[3] = std::sqrt(0.5);  // 90 deg to the left
  pose.velocity[0] = 0.42;
  for (int i = 0; i < 6; ++i) pose.covariance[7 * i] = i < 3 ? 0.01 : 0.0001;
  return pose;
}

Heard heard_of(const status_t& status, const pose_t& pose) {
  Heard heard;
  heard.take_status(encoded(status), kStart);
  heard.take_pose(encoded(pose), kStart);
  return heard;
}

View view_after(double seconds) {
  return {
      .url = "udpm://239.255.76.67:7667?ttl=0",
      .prefix = "",
      .now = kStart + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds)),
      .started_at = kStart};
}

TEST(TopLayout, ShowsEverythingOfAServiceThatTracks) {
  const Heard heard = heard_of(good_status(), good_pose());
  const std::string text = plain_text(lay_out(heard, view_after(0.3)));
  for (const char* part :
       {" TRACKING ", "quality ##############------ 72", "up 1:02:03", "reasons    none",
        "status 0.3 s ago", "position m x 12.35  y 0.00  z 0.00",
        "angles deg yaw 90.0 pitch 0.0 roll 0.0", "sigma      0.173 m  0.99 deg",
        "speed      0.42 m/s  driven 0.0 m", "rate       in 20.0 Hz  out 20.0 Hz",
        "median 12.3 ms  most 20.1 ms", "74468 in, 74460 tracked", "0 lost, 0 skipped",
        "v4l2:/dev/video0,/dev/video1", "exposure   -  gain -", "start of exposure", "45.6 MB",
        "recording  no", "160 x 120 px, avx2, version 0.1.0"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(TopLayout, FillsNoMoreThanATerminalOf80x24WhateverIsHeard) {
  Heard extreme = heard_of(extreme_status(), extreme_pose());
  extreme.take_update(encoded(extreme_update()));
  extreme.take_status(encoded(command_t{}), kStart);
  const Heard good = heard_of(good_status(), good_pose());
  for (const Glyphs glyphs : {Glyphs::kAscii, Glyphs::kUnicode}) {
    for (const Heard* heard : {&std::as_const(extreme), &good}) {
      for (const double seconds : {0.0, 5.0, 1e6}) {
        View view = view_after(seconds);
        view.glyphs = glyphs;
        view.prefix = std::string(200, 'p');
        const Page page = lay_out(*heard, view);
        EXPECT_LE(page.size(), static_cast<std::size_t>(kPageRows));
        for (const Row& row : page) EXPECT_LE(columns_of(row), kPageColumns) << plain_text(row);
      }
    }
  }
}

TEST(TopLayout, CutsNoFigureOffBesideTheMap) {
  status_t busy = good_status();
  busy.frames_in = busy.frames_tracked = 17'280'000;  // ten days at 20 Hz
  busy.frames_lost = 99'999;
  busy.latency_max_ms = 1234.5;
  busy.gain = 65535.0;
  busy.exposure_ms = 33.33;
  busy.stamp_uncertainty_ms = 0.1;
  busy.camera = "v4l2:/dev/video0,/dev/video1";
  pose_t far = good_pose();
  for (double& coordinate : far.translation) coordinate = -1234.56;
  far.rotation[0] = -0.02;
  for (const Page& section : {pose_section(heard_of(busy, far), true), frame_section(busy),
                              camera_section(busy), service_section(busy)}) {
    for (const Row& row : section) EXPECT_LE(columns_of(row), kSectionColumns) << plain_text(row);
  }
}

TEST(TopLayout, NamesStatesAndReasonsAndThoseItDoesNotKnow) {
  status_t status = good_status();
  status.state = status_t::STATE_LOST;
  status.reasons = update_t::REASON_LOW_TEXTURE | 0x40000000;
  status.reasons |= status_t::REASON_LATE;
  std::string text = plain_text(lay_out(heard_of(status, good_pose()), view_after(0.0)));
  EXPECT_THAT(text, AllOf(HasSubstr(" LOST "), HasSubstr("low_texture, late, 0x40000000")));
  status.state = 99;
  text = plain_text(lay_out(heard_of(status, good_pose()), view_after(0.0)));
  EXPECT_THAT(text, HasSubstr(" UNKNOWN "));
}

TEST(TopLayout, SaysWhenTheServiceFellSilent) {
  const std::string text =
      plain_text(lay_out(heard_of(good_status(), good_pose()), view_after(7.0)));
  EXPECT_THAT(text, AllOf(HasSubstr(" SILENT "), HasSubstr("No status for 7 s"),
                          HasSubstr("was TRACKING, quality 72"), HasSubstr("speed      - m/s"),
                          Not(HasSubstr(" TRACKING "))));
}

TEST(TopLayout, TellsNoSigmaWhereNoneIsKnown) {
  pose_t pose = good_pose();
  pose.covariance[0] = pose_t::UNKNOWN_VARIANCE;
  pose.velocity[0] = std::numeric_limits<double>::quiet_NaN();
  const std::string text = plain_text(lay_out(heard_of(good_status(), pose), view_after(0.0)));
  EXPECT_THAT(text, AllOf(HasSubstr("sigma      not known"), HasSubstr("speed      - m/s")));
}

TEST(TopLayout, SaysWhatToDoWhenNothingIsHeard) {
  Heard heard;
  EXPECT_THAT(plain_text(lay_out(heard, view_after(12.0))),
              AllOf(HasSubstr("NOT HEARD"), HasSubstr("for 12 s"), HasSubstr("darklingd running?"),
                    HasSubstr("lcm_url"), HasSubstr("multicast route")));
  heard.other_channel = "rover1/VO_STATUS";
  EXPECT_THAT(plain_text(lay_out(heard, view_after(3.0))), HasSubstr("--channel-prefix 'rover1/'"));
  heard.no_network = "LCM cannot be had on udpm://x";
  EXPECT_THAT(plain_text(lay_out(heard, view_after(3.0))),
              AllOf(HasSubstr("LCM cannot be had"), HasSubstr("ip route add")));
}

TEST(TopLayout, CountsMalformedMessagesAndKeepsWhatWasHeard) {
  Heard heard = heard_of(good_status(), good_pose());
  heard.take_status(encoded(good_pose()), kStart);
  heard.take_pose({}, kStart);
  heard.take_update(encoded(good_status()));
  EXPECT_EQ(heard.malformed, 3);
  EXPECT_THAT(plain_text(lay_out(heard, view_after(0.0))),
              AllOf(HasSubstr("3 malformed messages"), HasSubstr(" TRACKING ")));
}

TEST(TopLayout, DrawsTheMapOnlyWhereItFits) {
  Heard heard = heard_of(good_status(), good_pose());
  View view = view_after(0.0);
  EXPECT_THAT(plain_text(lay_out(heard, view)), HasSubstr("m, x up"));
  view.has_map = false;
  EXPECT_THAT(plain_text(lay_out(heard, view)), Not(HasSubstr("m, x up")));
}

TEST(TopLayout, HasALineForALog) {
  const Heard heard = heard_of(good_status(), good_pose());
  EXPECT_EQ(
      one_line(heard, view_after(0.5)),
      "TRACKING quality 72 in 20.0 Hz out 20.0 Hz latency 12.3 ms reasons none x 12.35 y 0.00 "
      "z 0.00 m driven 0.0 m");
  EXPECT_EQ(one_line(heard, view_after(5.0)), "SILENT 5 s");
}

TEST(TopLayout, WritesTimesForPeople) {
  EXPECT_EQ(time_text(0.0), "0:00:00");
  EXPECT_EQ(time_text(90061.0), "1 day 1:01:01");
  EXPECT_EQ(time_text(std::nan("")), "-");
  EXPECT_EQ(figure(-0.001, 1), "0.0");
  EXPECT_EQ(figure(-1.26, 1), "-1.3");
}

TEST(Attitude, IsYawThenPitchThenRoll) {
  const auto about = [](const Vector3& axis, double deg) {
    return Eigen::AngleAxisd(deg / 57.29577951308232, axis);
  };
  const Eigen::Quaterniond q(about(Vector3::UnitZ(), 100) * about(Vector3::UnitY(), -20) *
                             about(Vector3::UnitX(), 5));
  const Attitude attitude = attitude_of(q);
  EXPECT_NEAR(attitude.yaw_deg, 100.0, 1e-9);
  EXPECT_NEAR(attitude.pitch_deg, -20.0, 1e-9);
  EXPECT_NEAR(attitude.roll_deg, 5.0, 1e-9);
}

}  // namespace
}  // namespace darkling
