// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "app/bench/held_frames.h"
#include "kernels/kernel_table.h"
#include "vo/estimate.h"
#include "vo/odometry_config.h"

namespace darkling {

// What the odometry spent on one frame: time that its thread had of the processor. The refinement
// of the keyframe before it is done between frames, and in no frame's time.
struct PlayedFrame {
  bool is_keyframe = false;
  double frame_us = 0.0;
  std::array<double, kStageCount> stage_us = {};  // 0 where the stage did not run

  // What is in no stage: judging, prediction, the pose.
  [[nodiscard]] double rest_us() const;
};

struct Play {
  int width = 0;   // px, of the thumbnail
  int height = 0;  // px
  std::vector<PlayedFrame> frames;
};

// Runs a new odometry over all frames.
// @return any error of Odometry::create().
[[nodiscard]] Result<Play> play_frames(const HeldFrames& held, const OdometryConfig& config,
                                       const KernelTable& kernels);

// Frame by frame the median of every time. The same frames are the same work in every play, so this
// takes off what the machine did besides, and keeps what differs between frames.
// @pre at least one play, all of the same frames.
[[nodiscard]] std::vector<PlayedFrame> median_frames(std::span<const Play> plays);

// Mean time of the frames that are keyframes, or of those that are not; 0 when there is none.
[[nodiscard]] double mean_frame_us(std::span<const PlayedFrame> frames, bool is_keyframe);

}  // namespace darkling
