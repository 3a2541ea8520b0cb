// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/held_frames.h"
#include "app/bench/roofline.h"
#include "kernels/kernel_table.h"
#include "vo/odometry_config.h"

namespace darkling {

// Mean times of a frame with one setting.
struct SweepPoint {
  int width = 0;   // px
  int height = 0;  // px
  int points_per_level = 0;
  double other_us = 0.0;     // of frames that are no keyframes; 0 where there is none
  double keyframe_us = 0.0;  // likewise

  [[nodiscard]] double pixels() const { return static_cast<double>(width) * height; }
};

// How the cost grows along one series: as the pixels, or the points, to the power of the exponent.
// None where a time or a second setting is missing.
struct SweepSeries {
  std::vector<SweepPoint> points;
  std::optional<PowerLaw> others;
  std::optional<PowerLaw> keyframes;
};

struct SweepReport {
  std::string source;
  std::string kernels;
  int frames = 0;
  int repeats = 0;
  SweepSeries by_width;   // points as in the plan
  SweepSeries by_points;  // width as in the plan
};

struct SweepPlan {
  OdometryConfig config;
  KernelTable kernels;
  int repeats = 5;
  std::function<void(int done, int repeats)> show;
};

// Plays the frames with thumbnails 96 to 640 px wide, as far as the source is, and with 250 to 4000
// points a level; all settings in turns.
// @return any error of the odometry.
[[nodiscard]] Result<SweepReport> measure_sweep(const HeldFrames& held, const SweepPlan& plan);

// Fits `growing`, a figure of every setting, to both times.
void fit_series(double (*growing)(const SweepPoint& point), SweepSeries& series);

}  // namespace darkling
