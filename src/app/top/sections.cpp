// SPDX-License-Identifier: Apache-2.0
#include "app/top/sections.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <spdlog/fmt/fmt.h>

#include "app/top/attitude.h"
#include "base/number_text.h"

namespace darkling {

namespace {

constexpr double kDegPerRad = 57.29577951308232;
constexpr double kBytesPerMb = 1e6;

constexpr std::array<const char*, 4> kStampNames = {"of unknown origin", "on arrival",
                                                    "end of frame", "start of exposure"};

// Of the three variances from `first` on: the root of their sum; nothing where not known.
std::optional<double> sigma(const pose_t& pose, int first) {
  double variance = 0.0;
  for (int i = first; i < first + 3; ++i) {
    const double entry = pose.covariance[7 * i];
    if (!(entry >= 0.0) || entry >= pose_t::UNKNOWN_VARIANCE) return std::nullopt;
    variance += entry;
  }
  return std::sqrt(variance);
}

std::string sigma_text(const pose_t& pose) {
  const auto position_m = sigma(pose, 0);
  const auto angle_rad = sigma(pose, 3);
  if (!position_m || !angle_rad) return "not known";
  return figure(*position_m, 3) + " m  " + figure(*angle_rad * kDegPerRad, 2) + " deg";
}

Span count(std::int64_t number, const char* what, Tone tone_above_zero = Tone::kWarning) {
  return {fmt::format("{} {}", number, what), number > 0 ? tone_above_zero : Tone::kPlain};
}

// What the camera does not say is a negative number.
std::string known(double value, int decimals, const char* unit) {
  return value < 0.0 || std::isnan(value) ? "-" : figure(value, decimals) + unit;
}

}  // namespace

std::string figure(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  // Not "-0.0": a sign that comes and goes draws the eye to nothing.
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, decimals)
                                                            : text;
}

std::string time_text(double seconds) {
  constexpr double kMost_s = 1e10;
  if (!(seconds >= 0.0 && seconds < kMost_s)) return "-";
  const auto whole = static_cast<std::int64_t>(seconds);
  const std::int64_t days = whole / 86400;
  const std::string clock =
      fmt::format("{}:{:02}:{:02}", whole / 3600 % 24, whole / 60 % 60, whole % 60);
  return days == 0 ? clock : fmt::format("{} day{} {}", days, days == 1 ? "" : "s", clock);
}

Row labelled(const char* label, Row figures) {
  figures.insert(figures.begin(), Span{fmt::format("{:<{}}", label, kLabelColumns), Tone::kFaint});
  return figures;
}

Page pose_section(const Heard& heard, bool is_fresh) {
  if (!heard.pose) {
    return {labelled("position m", {{"no pose heard yet"}}), labelled("angles deg", {{"-"}}),
            labelled("sigma", {{"-"}}), labelled("speed", {{"-"}})};
  }
  const pose_t& pose = *heard.pose;
  const double* const t = pose.translation;
  const double* const q = pose.rotation;
  const double* const v = pose.velocity;
  const Attitude attitude = attitude_of(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  const double speed_mps = is_fresh ? Vector3(v[0], v[1], v[2]).norm() : std::nan("");
  return {labelled("position m", {{fmt::format("x {}  y {}  z {}", figure(t[0], 2), figure(t[1], 2),
                                               figure(t[2], 2))}}),
          labelled("angles deg",
                   {{fmt::format("yaw {} pitch {} roll {}", figure(attitude.yaw_deg, 1),
                                 figure(attitude.pitch_deg, 1), figure(attitude.roll_deg, 1))}}),
          labelled("sigma", {{sigma_text(pose)}}),
          labelled("speed", {{fmt::format("{} m/s  driven {} m", figure(speed_mps, 2),
                                          figure(heard.track.distance_m(), 1))}})};
}

Page frame_section(const status_t& status) {
  const bool is_behind = status.rate_out_hz < 0.9 * status.rate_in_hz;
  return {labelled("rate", {{fmt::format("in {} Hz  ", figure(status.rate_in_hz, 1))},
                            {fmt::format("out {} Hz", figure(status.rate_out_hz, 1)),
                             is_behind ? Tone::kWarning : Tone::kPlain}}),
          labelled("latency", {{"median " + known(status.latency_p50_ms, 1, " ms") + "  most " +
                                known(status.latency_max_ms, 1, " ms")}}),
          labelled("frames",
                   {{fmt::format("{} in, {} tracked", status.frames_in, status.frames_tracked)}}),
          labelled("of these", {count(status.frames_lost, "lost", Tone::kBad),
                                {", "},
                                count(status.frames_skipped, "skipped")}),
          labelled(
              "unusable",
              {count(status.frames_bad, "bad"), {", "}, count(status.frames_unpaired, "unpaired")}),
          labelled("device", {count(status.device_dropped, "dropped"),
                              {", "},
                              count(status.device_errors, "errors")}),
          labelled("late", {count(status.deadline_misses, "estimates"),
                            {", "},
                            count(status.refinement_overruns, "refinements")}),
          labelled("trouble", {count(status.publish_failures, "not sent"),
                               {", "},
                               count(status.wall_clock_steps, "clock steps")})};
}

Page camera_section(const status_t& status) {
  const bool is_known = status.stamp_source >= 0 &&
                        status.stamp_source < static_cast<std::int8_t>(kStampNames.size());
  std::string stamps = kStampNames[is_known ? static_cast<std::size_t>(status.stamp_source) : 0];
  if (status.stamp_uncertainty_ms > 0.0) {
    stamps += ", within " + figure(status.stamp_uncertainty_ms, 2) + " ms";
  }
  return {labelled("camera", {{printable(status.camera)}}),
          labelled("exposure", {{known(status.exposure_ms, 2, " ms") + "  gain " +
                                 (status.gain < 0.0 ? "-" : number_text(status.gain)) + "  skew " +
                                 figure(status.skew_ms, 2) + " ms"}}),
          labelled("stamps", {{stamps}})};
}

Page service_section(const status_t& status) {
  const double rss_mb = static_cast<double>(status.rss_bytes) / kBytesPerMb;
  const double arena_mb = static_cast<double>(status.arena_bytes) / kBytesPerMb;
  const std::string resident = status.rss_bytes > 0 ? figure(rss_mb, 1) + " MB" : "-";
  const Span heap = status.heap_calls < 0 ? Span{"not counted"}
                                          : count(status.heap_calls, "since the first frame");
  const Row recording =
      status.is_recording != 0
          ? Row{{fmt::format("{} frames, ", status.recorded_frames), Tone::kGood},
                count(status.record_drops, "left out")}
          : Row{{status.recorded_frames > 0 ? fmt::format("no, {} before", status.recorded_frames)
                                            : "no"}};
  return {
      labelled("memory", {{resident + ", of it arena " + figure(arena_mb, 1) + " MB"}}),
      labelled("heap calls", {heap}), labelled("recording", recording),
      labelled("tracks", {{fmt::format("{} x {} px, {}, version {}", status.width, status.height,
                                       printable(status.kernels), printable(status.version))}})};
}

}  // namespace darkling
