// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/remap_area.h"
#include "kernels/remap_area_steps.h"

// The weights of a row sum to 256, so that a weighted row, at most 255 · 256, fits 16 bits.

namespace darkling {
namespace {

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

// One output pixel with at most four taps: its four weighted rows.
uint32x4_t weigh_4x4(const RemapSource& s, const AreaMapEntry& e) {
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
uint32x4_t weigh_wide(const RemapSource& s, const AreaMapEntry& e) {
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

uint32x4_t weigh(const RemapSource& s, const AreaMapEntry& e) {
  return s.taps <= 4 ? weigh_4x4(s, e) : weigh_wide(s, e);
}

// Four output pixels, rounded.
uint16x4_t remap_4(const RemapSource& s, const AreaMapEntry* e) {
  const uint32x4_t sums = add_pairs(add_pairs(weigh(s, e[0]), weigh(s, e[1])),
                                    add_pairs(weigh(s, e[2]), weigh(s, e[3])));
  return vrshrn_n_u32(sums, 16);
}

void remap_8(const RemapSource& s, const AreaMapEntry* e, std::uint8_t* out) {
  vst1_u8(out, vmovn_u16(vcombine_u16(remap_4(s, e), remap_4(s, e + 4))));
}

}  // namespace

void remap_area_neon(const AreaMap& map, ImageView<const std::uint8_t> src,
                     ImageView<std::uint8_t> dst) {
  remap_area_by_eights(map, src, dst, remap_8);
}

}  // namespace darkling
