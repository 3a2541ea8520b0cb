// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "kernels/remap_area.h"
#include "kernels/remap_area_steps.h"

namespace darkling {

namespace {

std::uint8_t remap_pixel(const AreaMap& map, const AreaMapEntry& entry, const std::uint8_t* src,
                         std::ptrdiff_t stride) {
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

}  // namespace

void remap_area_by_eights(const AreaMap& map, const ImageView<const std::uint8_t>& src,
                          const ImageView<std::uint8_t>& dst, RemapEightFn* remap_eight) {
  RemapSource source = {src.data, src.stride, map.weights, map.taps, {}};
  for (int j = 0; j < 8; ++j) source.rows[j] = std::min(j, map.taps - 1) * src.stride;
  const int columns_read = map.taps <= 4 ? 4 : (map.taps + 7) / 8 * 8;
  const int last_x = src.width - columns_read;
  for (int v = 0; v < dst.height; ++v) {
    const AreaMapEntry* entries = map.entries.row(v);
    std::uint8_t* out = dst.row(v);
    int u = 0;
    while (u < dst.width) {
      const int end = std::min(u + 8, dst.width);
      const bool fits = end - u == 8 && std::all_of(entries + u, entries + end,
                                                    [=](const auto& e) { return e.x <= last_x; });
      if (fits) remap_eight(source, entries + u, out + u);
      for (; !fits && u < end; ++u) out[u] = remap_pixel(map, entries[u], src.data, src.stride);
      u = end;
    }
  }
}

void remap_area_ref(const AreaMap& map, ImageView<const std::uint8_t> src,
                    ImageView<std::uint8_t> dst) {
  for (int v = 0; v < dst.height; ++v) {
    const AreaMapEntry* entries = map.entries.row(v);
    std::uint8_t* out = dst.row(v);
    for (int u = 0; u < dst.width; ++u) {
      out[u] = remap_pixel(map, entries[u], src.data, src.stride);
    }
  }
}

}  // namespace darkling
