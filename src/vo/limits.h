// SPDX-License-Identifier: Apache-2.0
// Every capacity of the pipeline. What is larger is refused at start, by these names.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/remap_area.h"

namespace darkling {

inline constexpr int kMinWidth = 64;                    // px, thumbnail
inline constexpr int kMaxWidth = 1280;                  // px, thumbnail
inline constexpr int kMinHeight = 24;                   // px, thumbnail
inline constexpr int kMaxHeight = 1024;                 // px, thumbnail
inline constexpr int kMaxReduction = kMaxAreaTaps - 1;  // source px a thumbnail px, one direction
inline constexpr int kMaxLevels = 6;
inline constexpr int kMaxPointsPerLevel = 4000;
// With 60 no keyframe ever came about: some cells of the grid are empty, and 60 must be left.
inline constexpr int kMinPointsPerLevel = 100;
inline constexpr int kMinWindowKeyframes = 2;
inline constexpr int kMaxWindowKeyframes = 8;
inline constexpr int kMinWindowPoints = 50;    // of a keyframe
inline constexpr int kMaxWindowPoints = 1000;  // of a keyframe
// Keyframes that a lost track may find itself again by. Half of them stay for World's own track.
inline constexpr int kRingKeyframes = 20;
inline constexpr int kRingPoints = 512;       // of each at the finest level, at most
inline constexpr int kRingCoarsePoints = 64;  // of each at every other level, at most
// px, of the level that is matched densely: 32 disparities are a sixth of it.
inline constexpr int kMaxStereoWidth = 192;

// The coarsest level of the pyramid is the one whose width is nearest to this, on a log scale. With
// steps of 3.6 m between frames of a car, three levels from 310 px failed (11 %), four gave 0.7 %.
inline constexpr int kCoarsestWidth = 40;

// The most stack that track() and skip() use, by any kernel and compiled without optimisation too.
inline constexpr std::size_t kMaxStackBytes = std::size_t{32} << 10;

// The most memory the odometry may claim at start: 8 MiB at 320x240, 24 MiB at 640x480, and on the
// straight line through both in pixels at every other size.
[[nodiscard]] constexpr std::size_t memory_budget_bytes(int width_px, int height_px) {
  constexpr std::uint64_t kMiB = 1u << 20;  // 64 bits: the products are too large for 32
  constexpr std::uint64_t kSmallPixels = 320 * 240;
  constexpr std::uint64_t kStepPixels = 640 * 480 - kSmallPixels;
  const std::uint64_t pixels = std::uint64_t(width_px) * std::uint64_t(height_px);
  return static_cast<std::size_t>(8 * kMiB - 16 * kMiB * kSmallPixels / kStepPixels +
                                  16 * kMiB * pixels / kStepPixels);
}
static_assert(memory_budget_bytes(320, 240) == std::size_t{8} << 20);
static_assert(memory_budget_bytes(640, 480) == std::size_t{24} << 20);

}  // namespace darkling
