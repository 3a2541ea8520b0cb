// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/check.h"
#include "kernels/bit_planes.h"

namespace darkling {

SmoothingTaps make_smoothing_taps(double sigma_px) {
  CHECK(sigma_px >= 0.0 && sigma_px <= 1.75, "smoothing sigma outside 0…1.75 px");
  SmoothingTaps taps;
  if (sigma_px == 0.0) return taps;
  double shape[SmoothingTaps::kMaxRadius + 1];
  double sum = 0.0;
  for (int k = 0; k <= SmoothingTaps::kMaxRadius; ++k) {
    shape[k] = std::exp(-0.5 * k * k / (sigma_px * sigma_px));
    sum += k == 0 ? shape[k] : 2.0 * shape[k];
  }
  int left_over = 64;
  for (int k = SmoothingTaps::kMaxRadius; k > 0; --k) {
    taps.w[k] = static_cast<std::uint8_t>(std::lround(64.0 * shape[k] / sum));
    if (taps.w[k] > 0 && taps.radius == 0) taps.radius = k;
    left_over -= 2 * taps.w[k];
  }
  taps.w[0] = static_cast<std::uint8_t>(left_over);  // so that a constant stays constant
  return taps;
}

}  // namespace darkling
