// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace darkling {

// What to render: `synthetic:SCENE[,key=value…]`; the members are the keys.
struct SyntheticSpec {
  std::string scene;  // mine, quarry or corridor
  int frames = 200;
  std::uint64_t seed = 1;  // of the scene, the motion and the noise
  int width = 320;         // px
  int height = 0;          // px; 0 = three quarters of the width
  double rate_hz = 20.0;
  double speed = 0.9;        // m/s, where the way is straight and clear
  double exposure_ms = 5.0;  // shutter time; twice as long is twice as bright
  double gain = 1.0;         // of the amplifier: brighter without more light, so noisier
  // Photo-electrons that a pixel at level 128 has collected at the scene's light with 5 ms and
  // gain 1: the amount of light. 4000 is a good camera in daylight, 100 is dusk, 5 is night.
  double electrons = 4000.0;
  double read_noise_e = 8.0;    // standard deviation, electrons
  double vignetting = 0.5;      // 0 none … 1 the fourth power of the cosine
  double distortion = 0.0;      // 0 pinhole … 1 a wide lens, radial-tangential
  double roll_right_deg = 0.0;  // the right camera is mounted turned about its axis
  bool blur = true;             // the shutter is open while the rover moves
};

// @return kUsage with what was found and what is allowed.
[[nodiscard]] Result<SyntheticSpec> parse_synthetic(std::string_view text);

// Sets one key from its text. @return kUsage as parse_synthetic().
[[nodiscard]] Result<void> set_synthetic_key(SyntheticSpec& spec, std::string_view name,
                                             std::string_view value);

// Refuses unknown scenes and values out of range; fills in the height.
[[nodiscard]] Result<void> check_synthetic(SyntheticSpec& spec);

}  // namespace darkling
