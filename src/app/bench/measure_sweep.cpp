// SPDX-License-Identifier: Apache-2.0
#include "app/bench/measure_sweep.h"

#include "app/bench/play_frames.h"

namespace darkling {

namespace {

constexpr int kWidths[] = {96, 128, 160, 240, 320, 480, 640};  // px
constexpr int kPoints[] = {250, 500, 1000, 2000, 4000};

using Plays = std::vector<std::vector<Play>>;  // of each setting

std::vector<OdometryConfig> list_settings(const HeldFrames& held, const OdometryConfig& base) {
  std::vector<OdometryConfig> settings;
  for (const int width : kWidths) {
    if (width > held.rig.left.width) continue;
    settings.push_back(base);
    settings.back().width_px = width;
  }
  for (const int points : kPoints) {
    settings.push_back(base);
    settings.back().points_per_level = points;
  }
  return settings;
}

Result<Plays> play_settings(const HeldFrames& held, const std::vector<OdometryConfig>& settings,
                            const SweepPlan& plan) {
  Plays plays(settings.size());
  for (int repeat = 0; repeat < plan.repeats; ++repeat) {
    for (std::size_t i = 0; i < settings.size(); ++i) {
      auto play = play_frames(held, settings[i], plan.kernels);
      if (!play) return tl::unexpected(play.error());
      plays[i].push_back(std::move(*play));
    }
    if (plan.show) plan.show(repeat + 1, plan.repeats);
  }
  return plays;
}

std::optional<PowerLaw> fit(double (*growing)(const SweepPoint& point), double SweepPoint::*time_us,
                            const std::vector<SweepPoint>& points) {
  std::vector<double> x;
  std::vector<double> y;
  for (const SweepPoint& point : points) {
    if (point.*time_us <= 0.0) continue;
    x.push_back(growing(point));
    y.push_back(point.*time_us);
  }
  if (x.size() < 2) return std::nullopt;
  return fit_power_law(x, y);
}

}  // namespace

void fit_series(double (*growing)(const SweepPoint& point), SweepSeries& series) {
  series.others = fit(growing, &SweepPoint::other_us, series.points);
  series.keyframes = fit(growing, &SweepPoint::keyframe_us, series.points);
}

Result<SweepReport> measure_sweep(const HeldFrames& held, const SweepPlan& plan) {
  const std::vector<OdometryConfig> settings = list_settings(held, plan.config);
  const auto plays = play_settings(held, settings, plan);
  if (!plays) return tl::unexpected(plays.error());
  SweepReport report;
  report.source = held.source;
  report.kernels = plan.kernels.name;
  report.frames = static_cast<int>(held.frames.size());
  report.repeats = plan.repeats;
  const std::size_t width_count = settings.size() - std::size(kPoints);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const std::vector<PlayedFrame> frames = median_frames((*plays)[i]);
    SweepSeries& series = i < width_count ? report.by_width : report.by_points;
    series.points.push_back({.width = (*plays)[i].front().width,
                             .height = (*plays)[i].front().height,
                             .points_per_level = settings[i].points_per_level,
                             .other_us = mean_frame_us(frames, false),
                             .keyframe_us = mean_frame_us(frames, true)});
  }
  fit_series([](const SweepPoint& p) { return p.pixels(); }, report.by_width);
  fit_series([](const SweepPoint& p) { return double(p.points_per_level); }, report.by_points);
  return report;
}

}  // namespace darkling
