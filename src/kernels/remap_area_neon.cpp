// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/remap_area.h"

// The weights of a row sum to 256, so that a weighted row, at most 255 · 256, fits 16 bits.

namespace darkling {
namespace {

constexpr int kPixels = 8;  // of the output, a step

// Sums of neighbours, those of `a` first.
uint16x8_t add_pairs(uint16x8_t a, uint16x8_t b) {
#if defined(__aarch64__)
  return vpaddq_u16(a, b);
#else
  return vcombine_u16(vpadd_u16(vget_low_u16(a), vget_high_u16(a)),
                      vpadd_u16(vget_low_u16(b), vget_high_u16(b)));
#endif
}
uint32x4_t add_pairs(uint32x4_t a, uint32x4_t b) {
#if defined(__aarch64__)
  return vpaddq_u32(a, b);
#else
  return vcombine_u32(vpadd_u32(vget_low_u32(a), vget_high_u32(a)),
                      vpadd_u32(vget_low_u32(b), vget_high_u32(b)));
#endif
}

uint8x8_t load_4_and_4(const std::uint8_t* a, const std::uint8_t* b) {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  __builtin_memcpy(&low, a, sizeof(low));
  __builtin_memcpy(&high, b, sizeof(high));
  return vreinterpret_u8_u32(vset_lane_u32(high, vdup_n_u32(low), 1));
}

// The source of one image.
struct Source {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride;
  const std::uint8_t* weights;
  int taps;
  // Where the first four rows of a box begin. Rows beyond `taps` have no weight but may lie outside
  // the image, so the last row stands in.
  std::ptrdiff_t rows[4];
};

Source make_source(const AreaMap& map, const ImageView<const std::uint8_t>& src) {
  Source source = {src.data, src.stride, map.weights, map.taps, {}};
  for (int j = 0; j < 4; ++j) source.rows[j] = (j < map.taps ? j : map.taps - 1) * src.stride;
  return source;
}

// One output pixel with at most four taps: its four weighted rows.
uint32x4_t weigh_4x4(const Source& s, const AreaMapEntry& e) {
  const std::uint8_t* p = s.pixels + e.y * s.stride + e.x;
  const std::uint8_t* wx = s.weights + e.phase_x * kMaxAreaTaps;
  const std::uint8_t* wy = s.weights + e.phase_y * kMaxAreaTaps;
  const uint8x8_t along = load_4_and_4(wx, wx);
  const uint16x8_t upper = vmull_u8(load_4_and_4(p, p + s.rows[1]), along);
  const uint16x8_t lower = vmull_u8(load_4_and_4(p + s.rows[2], p + s.rows[3]), along);
  const uint16x8_t halves = add_pairs(upper, lower);
  const uint16x4_t rows = vpadd_u16(vget_low_u16(halves), vget_high_u16(halves));
  return vmull_u16(rows, vget_low_u16(vmovl_u8(load_4_and_4(wy, wy))));
}

// One output pixel with any number of taps, the sum of its box in four parts. Reads whole groups of
// eight columns.
uint32x4_t weigh_wide(const Source& s, const AreaMapEntry& e) {
  const std::uint8_t* wx = s.weights + e.phase_x * kMaxAreaTaps;
  const std::uint8_t* wy = s.weights + e.phase_y * kMaxAreaTaps;
  const std::uint8_t* p = s.pixels + e.y * s.stride + e.x;
  uint32x4_t sum = vdupq_n_u32(0);
  for (int j = 0; j < s.taps; ++j, p += s.stride) {
    uint16x8_t along = vmull_u8(vld1_u8(p), vld1_u8(wx));
    for (int i = 8; i < s.taps; i += 8) along = vmlal_u8(along, vld1_u8(p + i), vld1_u8(wx + i));
    sum = vmlal_n_u16(sum, vpadd_u16(vget_low_u16(along), vget_high_u16(along)), wy[j]);
  }
  return sum;
}

uint32x4_t weigh(const Source& s, const AreaMapEntry& e) {
  return s.taps <= 4 ? weigh_4x4(s, e) : weigh_wide(s, e);
}

// Four output pixels, rounded.
uint16x4_t remap_4(const Source& s, const AreaMapEntry* e) {
  const uint32x4_t sums = add_pairs(add_pairs(weigh(s, e[0]), weigh(s, e[1])),
                                    add_pairs(weigh(s, e[2]), weigh(s, e[3])));
  return vrshrn_n_u32(sums, 16);
}

void remap_8(const Source& s, const AreaMapEntry* e, std::uint8_t* out) {
  vst1_u8(out, vmovn_u16(vcombine_u16(remap_4(s, e), remap_4(s, e + 4))));
}

}  // namespace

void remap_area_neon(const AreaMap& map, ImageView<const std::uint8_t> src,
                     ImageView<std::uint8_t> dst) {
  const Source source = make_source(map, src);
  const int columns_read = map.taps <= 4 ? 4 : (map.taps + 7) / 8 * 8;
  const int last_x = src.width - columns_read;
  for (int v = 0; v < dst.height; ++v) {
    const AreaMapEntry* entries = map.entries.data + v * map.entries.stride;
    std::uint8_t* out = dst.data + v * dst.stride;
    int u = 0;
    for (; u + kPixels <= dst.width; u += kPixels) {
      bool is_inside = true;
      for (int i = 0; i < kPixels; ++i) is_inside = is_inside && entries[u + i].x <= last_x;
      if (is_inside) {
        remap_8(source, entries + u, out + u);
        continue;
      }
      for (int i = u; i < u + kPixels; ++i) {
        out[i] = remap_area_pixel(map, entries[i], src.data, src.stride);
      }
    }
    for (; u < dst.width; ++u) {
      out[u] = remap_area_pixel(map, entries[u], src.data, src.stride);
    }
  }
}

}  // namespace darkling
