// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/image_view.h"

namespace darkling {

// Eight planes an image, one a census neighbour, interleaved: the eight values of a pixel are
// neighbouring bytes, so one 16-byte load holds two pixels and sampling all planes bilinearly is
// two loads. A view of planes is an image of bytes, 8 · width wide.
inline constexpr int kPlaneCount = 8;

// Gaussian taps that sum to 64, the middle one first: w[0] at 0, w[k] at ±k.
struct SmoothingTaps {
  static constexpr int kMaxRadius = 4;
  std::array<std::uint8_t, kMaxRadius + 1> w = {64, 0, 0, 0, 0};
  int radius = 0;
};

// @param sigma_px  of the Gaussian, at most 1.75 px; 0 leaves the planes as they are.
[[nodiscard]] SmoothingTaps make_smoothing_taps(double sigma_px);

// Smoothed bit-planes of census codes (kernels/census.h): every bit becomes 0 or 255 in its plane,
// and every plane is smoothed by the taps, down the columns and then along the rows.
//
// @param codes    census codes, w × h.
// @param scratch  one row of 8 · (w + 2 · kMaxRadius) bytes.
// @param dst      8 · w × h bytes; may not overlap `codes`.
// Beyond the border the nearest pixel stands in.
// Exactness: rounds half up after each direction; every variant equals the reference bit for bit.
// Source: Alismail, Browning, Lucey, "Robust tracking in low light and sudden illumination
// changes", 3DV 2016.
using BitPlanesFn = void(ImageView<const std::uint8_t> codes, const SmoothingTaps& taps,
                         std::uint8_t* scratch, ImageView<std::uint8_t> dst);

BitPlanesFn bit_planes_ref;

}  // namespace darkling
