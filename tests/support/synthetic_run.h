// SPDX-License-Identifier: Apache-2.0
// Frames of a rendered scene kept in memory, to be played in any order and spoilt by a test.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/stereo_frame.h"
#include "geometry/stereo_rig.h"

namespace darkling::test {

struct KeptFrame {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> left;  // row by row, no padding
  std::vector<std::uint8_t> right;

  // 20 frames a second.
  [[nodiscard]] StereoFrame at(std::int64_t sequence) const;
};

struct SyntheticRun {
  StereoRig rig;
  std::vector<KeptFrame> frames;
  std::vector<Se3> T_world_body;  // the truth, a pose a frame
};

// Renders once a program: what was asked for before is given again.
// @param text  as on the command line, without "synthetic:": "corridor,frames=8,width=160".
[[nodiscard]] const SyntheticRun& synthetic_run(const std::string& text);

// The same level everywhere, or noise without any pattern.
[[nodiscard]] KeptFrame flat_frame(const KeptFrame& like, std::uint8_t level);
[[nodiscard]] KeptFrame noise_frame(const KeptFrame& like, unsigned seed);

}  // namespace darkling::test
