// SPDX-License-Identifier: Apache-2.0
#include "kernels/remap_area.h"

namespace darkling {

std::uint8_t remap_area_pixel(const AreaMap& map, const AreaMapEntry& entry,
                              const std::uint8_t* src, std::ptrdiff_t stride) {
  const std::uint8_t* wx = map.weights + entry.phase_x * kMaxAreaTaps;
  const std::uint8_t* wy = map.weights + entry.phase_y * kMaxAreaTaps;
  const std::uint8_t* p = src + entry.y * stride + entry.x;
  std::uint32_t sum = 1u << 15;
  for (int j = 0; j < map.taps; ++j, p += stride) {
    std::uint32_t row_sum = 0;  // at most 255 · 256
    for (int i = 0; i < map.taps; ++i) row_sum += std::uint32_t{wx[i]} * p[i];
    sum += wy[j] * row_sum;
  }
  return static_cast<std::uint8_t>(sum >> 16);
}

void remap_area_ref(const AreaMap& map, ImageView<const std::uint8_t> src,
                    ImageView<std::uint8_t> dst) {
  for (int v = 0; v < dst.height; ++v) {
    const AreaMapEntry* entries = map.entries.row(v);
    std::uint8_t* out = dst.row(v);
    for (int u = 0; u < dst.width; ++u) {
      out[u] = remap_area_pixel(map, entries[u], src.data, src.stride);
    }
  }
}

}  // namespace darkling
