// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "kernels/blur3.h"

namespace darkling {

void blur3_ref(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  const int last = src.width - 1;
  for (int y = 0; y < src.height; ++y) {
    const std::uint8_t* above = src.row(std::max(y - 1, 0));
    const std::uint8_t* here = src.row(y);
    const std::uint8_t* below = src.row(std::min(y + 1, src.height - 1));
    std::uint8_t* out = dst.row(y);
    const auto column = [=](int x) { return above[x] + 2 * here[x] + below[x]; };
    const auto blur = [&](int l, int x, int r) {
      out[x] = static_cast<std::uint8_t>((column(l) + 2 * column(x) + column(r) + 8) >> 4);
    };
    blur(0, 0, std::min(1, last));
    for (int x = 1; x < last; ++x) blur(x - 1, x, x + 1);
    if (last > 0) blur(last - 1, last, last);
  }
}

}  // namespace darkling
