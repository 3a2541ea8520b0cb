// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/counting_kernels.h"
#include "app/bench/measure_kernels.h"
#include "app/bench/play_frames.h"
#include "io/statistics.h"

namespace darkling {

// Microseconds, over the frames that ran the stage.
struct StageTimes {
  std::string name;
  std::optional<Percentiles> all;
  std::optional<Percentiles> keyframes;
  std::optional<Percentiles> others;
};

// What the frames of one kind have to do, on average, and how long that takes.
struct FrameCost {
  int frames = 0;
  FrameWork work = {};       // counted, of one frame
  Roofline least;            // of `work`
  double kernels_us = 0.0;   // `work` at the speed that each kernel was measured at by itself
  double measured_us = 0.0;  // the whole frame
};

struct StageReport {
  std::string source;
  std::string kernels;
  int width = 0;   // px, of the thumbnail
  int height = 0;  // px
  int points_per_level = 0;
  int repeats = 0;
  std::vector<StageTimes> stages;  // in their order, then what is in none of them, then the frame
  double rectify_share = 0.0;      // of the time of all frames
  FrameCost keyframes;
  FrameCost others;
};

struct StagePlan {
  OdometryConfig config;
  KernelTable kernels;
  int repeats = 10;
  std::function<void(int done, int repeats)> show;
};

// Plays the frames again and again, and once more to count what the kernels have to do.
// @return any error of the odometry.
[[nodiscard]] Result<StageReport> measure_stages(const HeldFrames& held, const StagePlan& plan);

// Fills in what `report` can say only beside the speed of the kernels.
// @param speed  of one table, the one of `report`, at the same size of thumbnail.
void compare_with_kernels(const KernelReport& speed, StageReport& report);

}  // namespace darkling
