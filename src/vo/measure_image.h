// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// Of the image, from top to bottom: what arrives late of an image are whole rows.
inline constexpr int kBandCount = 8;

struct ImageBand {
  std::uint64_t hash = 0;  // of the pixels looked at: the same band, the same hash
  bool is_plain = true;    // at most half of it has any texture or noise: it may repeat by chance
};

// What an image says about itself, from every third pixel of every third row.
struct ImageMeasure {
  double noise = 0.0;         // standard deviation, grey levels
  double dark_share = 0.0;    // of the pixels, 0…1: next to black
  double bright_share = 0.0;  // clipped, or nearly
  std::array<ImageBand, kBandCount> bands = {};
};

// Along x and along y: mean square of the differences of neighbours over that of pixels four apart,
// both without what noise explains. A sixteenth is a slope; a quarter, a sharp step; 1, what
// changes from pixel to pixel. 0: not known, as noise explains most.
using Sharpness = std::array<double, 2>;

// @param noise  of the image: standard deviation, grey levels.
// @pre at least 5×5.
[[nodiscard]] Sharpness measure_sharpness(const ImageView<const std::uint8_t>& grey, double noise);

// How much of an image is that of another one.
struct Repetition {
  bool is_whole = false;
  bool is_partial = false;  // a band that is not plain repeats, others do not
};
[[nodiscard]] Repetition repetition_of(const ImageMeasure& image, const ImageMeasure& other);

// Noise is what is left of the image where nothing else is. A mask that any plane of brightness and
// any straight edge along the axes leaves at zero,
//
//    1 -2  1
//   -2  4 -2   responds to white noise of deviation σ with one of 6 σ.
//    1 -2  1
//
// Where there is texture it responds to that too, so the level is read off the calmest quarter of
// the image: the first quartile of |response|, which for noise alone lies at 0.3186 · 6 σ. Over
// real and rendered images with noise of a known σ put in it reads 0.75 to 1.0 σ (less where it is
// dark: photon noise is less there) and, without, 1.0 to 2.6, much of which is their own noise.
//
// @param grey  smaller than 3×3 it is taken for free of noise.
// Source: Immerkær, "Fast noise variance estimation", CVIU 1996.
[[nodiscard]] ImageMeasure measure_image(const ImageView<const std::uint8_t>& grey);

// The differences of blurred neighbours, in grey levels, that noise of deviation `noise` explains:
// what bit-planes are computed with. In proportion to the noise, as the noise is to the gain: else
// the planes would not be the same under any gain.
[[nodiscard]] int dead_zone_of(double noise);

}  // namespace darkling
