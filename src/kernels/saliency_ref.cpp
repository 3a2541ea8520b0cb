// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>

#include "kernels/bit_planes.h"
#include "kernels/saliency.h"

namespace darkling {

void saliency_ref(ImageView<const std::uint8_t> planes, ImageView<std::uint16_t> dst) {
  std::fill_n(dst.row(0), dst.width, std::uint16_t{0});
  std::fill_n(dst.row(dst.height - 1), dst.width, std::uint16_t{0});
  for (int y = 1; y < dst.height - 1; ++y) {
    const std::uint8_t* above = planes.row(y - 1);
    const std::uint8_t* here = planes.row(y);
    const std::uint8_t* below = planes.row(y + 1);
    std::uint16_t* out = dst.row(y);
    out[0] = 0;
    out[dst.width - 1] = 0;
    for (int x = 1; x < dst.width - 1; ++x) {
      int sum = 0;
      for (int c = 0; c < kPlaneCount; ++c) {
        const int i = x * kPlaneCount + c;
        sum +=
            std::abs(here[i + kPlaneCount] - here[i - kPlaneCount]) + std::abs(below[i] - above[i]);
      }
      out[x] = static_cast<std::uint16_t>(sum);
    }
  }
}

}  // namespace darkling
