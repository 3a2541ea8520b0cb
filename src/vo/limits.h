// SPDX-License-Identifier: Apache-2.0
// Every capacity of the pipeline. What is larger is refused at start, by these names.
#pragma once

namespace darkling {

inline constexpr int kMinWidth = 64;     // px, thumbnail
inline constexpr int kMaxWidth = 1280;   // px, thumbnail
inline constexpr int kMinHeight = 24;    // px, thumbnail
inline constexpr int kMaxHeight = 1024;  // px, thumbnail
inline constexpr int kMaxLevels = 6;
inline constexpr int kMaxPointsPerLevel = 4000;
inline constexpr int kMinPointsPerLevel = 50;
// px, of the level that is matched densely: 32 disparities are a sixth of it.
inline constexpr int kMaxStereoWidth = 192;

// The coarsest level of the pyramid is the one whose width is nearest to this, on a log scale. With
// steps of 3.6 m between frames of a car, three levels from 310 px failed (11 %), four gave 0.7 %.
inline constexpr int kCoarsestWidth = 40;

}  // namespace darkling
