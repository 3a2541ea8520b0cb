// SPDX-License-Identifier: Apache-2.0
#include "kernels/remap_area.h"

namespace darkling {

void remap_area_ref(const AreaMap& map, ImageView<const std::uint8_t> src,
                    ImageView<std::uint8_t> dst) {
  for (int v = 0; v < dst.height; ++v) {
    const AreaMapEntry* entry = map.entries.row(v);
    for (int u = 0; u < dst.width; ++u) {
      const AreaMapEntry& e = entry[u];
      const std::uint16_t* wx = &map.weights[e.phase_x * kMaxAreaTaps];
      const std::uint16_t* wy = &map.weights[e.phase_y * kMaxAreaTaps];
      const std::uint8_t* p = src.row(e.y) + e.x;
      std::uint32_t sum = 1u << 15;
      for (int j = 0; j < map.taps; ++j, p += src.stride) {
        std::uint32_t row_sum = 0;  // at most 255 · 256
        for (int i = 0; i < map.taps; ++i) row_sum += wx[i] * p[i];
        sum += wy[j] * row_sum;
      }
      dst.at(u, v) = static_cast<std::uint8_t>(sum >> 16);
    }
  }
}

}  // namespace darkling
