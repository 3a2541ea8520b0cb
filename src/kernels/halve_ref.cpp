// SPDX-License-Identifier: Apache-2.0
#include "kernels/halve.h"

namespace darkling {

void halve_ref(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  for (int y = 0; y < dst.height; ++y) {
    const std::uint8_t* a = src.row(2 * y);
    const std::uint8_t* b = src.row(2 * y + 1);
    std::uint8_t* out = dst.row(y);
    for (int x = 0; x < dst.width; ++x) {
      out[x] =
          static_cast<std::uint8_t>((a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) >> 2);
    }
  }
}

}  // namespace darkling
