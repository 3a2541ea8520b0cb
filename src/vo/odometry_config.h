// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// What alignment and the sub-pixel step of stereo compare: signs of differences of brightness, or
// grey levels (vo/compare_intensity.h).
enum class Descriptor { kBitplanes, kIntensity };

// How disparities are found densely: with the five paths, or by the least cost of a window alone.
enum class StereoMethod { kSemiGlobal, kBlock };

// What a user may set of the algorithm. Everything else is a named constant beside the code that
// uses it. Units, ranges and defaults are published by io/config.cpp from one table.
struct OdometryConfig {
  int width_px = 320;           // thumbnail width; 0 = the source's
  int points_per_level = 1000;  // template points at most; half as many on coarse levels
  Descriptor descriptor = Descriptor::kBitplanes;
  StereoMethod stereo = StereoMethod::kSemiGlobal;
  bool refinement = true;    // of the last keyframes together
  int window_keyframes = 5;  // that are refined together
  int window_points = 400;   // of each of them, at most
};

}  // namespace darkling
