// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/bit_planes.h"
#include "kernels/bit_planes_rows.h"

namespace darkling {
namespace {

constexpr int kBytes = 16;  // a vector

// [1 2 1] down the columns x … x + 15.
struct Columns {
  uint16x8_t low;
  uint16x8_t high;
};

Columns columns_at(const BlurRow& row, int x) {
  const uint8x16_t above = vld1q_u8(row.above + x);
  const uint8x16_t here = vld1q_u8(row.here + x);
  const uint8x16_t below = vld1q_u8(row.below + x);
  const auto column = [](uint8x8_t a, uint8x8_t h, uint8x8_t b) {
    return vaddq_u16(vaddl_u8(a, b), vshll_n_u8(h, 1));
  };
  return {column(vget_low_u8(above), vget_low_u8(here), vget_low_u8(below)),
          column(vget_high_u8(above), vget_high_u8(here), vget_high_u8(below))};
}

// [1 2 1] along the row, rounded.
uint8x8_t blur_8(uint16x8_t left, uint16x8_t here, uint16x8_t right) {
  return vrshrn_n_u16(vaddq_u16(vaddq_u16(left, right), vshlq_n_u16(here, 1)), 4);
}

void blur_16(const BlurRow& row, int x) {
  const Columns left = columns_at(row, x - 1);
  const Columns right = columns_at(row, x + 1);
  const uint16x8_t low_here = vextq_u16(left.low, left.high, 1);
  const uint16x8_t high_here = vextq_u16(right.low, right.high, 7);
  vst1q_u8(row.blurred + x, vcombine_u8(blur_8(left.low, low_here, right.low),
                                        blur_8(left.high, high_here, right.high)));
}

void blur_row(const BlurRow& row) {
  const int last = row.width - 1;
  if (last - 1 < kBytes) {
    blur_columns(row, 0, row.width);
    return;
  }
  const BlurRow local = row;  // else each store might have moved the pointers
  for (int x = 1; x + kBytes <= last; x += kBytes) blur_16(local, x);
  blur_16(local, last - kBytes);  // overlaps the one before: no read goes past the row
  blur_columns(row, 0, 1);
  blur_columns(row, last, row.width);
}

// Moves the codes one bit down and puts the next neighbour's bit on top. A rounded average with a
// mask of 0 or 255 does both, without rounding: seven moves leave the lowest bit clear.
void census_16(const CensusRow& row, int x) {
  const std::uint8_t* const neighbours[kPlaneCount] = {
      row.above + x - 1, row.above + x,     row.above + x + 1, row.here + x - 1,
      row.here + x + 1,  row.below + x - 1, row.below + x,     row.below + x + 1};
  const uint8x16_t centre = vld1q_u8(row.here + x);
  const uint8x16_t high = vqaddq_u8(centre, vdupq_n_u8(row.dead_zone));
  const uint8x16_t low = vqsubq_u8(centre, vdupq_n_u8(row.dead_zone));
  uint8x16_t brighter = vdupq_n_u8(0);
  uint8x16_t above_low = vdupq_n_u8(0);
  for (const std::uint8_t* neighbour : neighbours) {
    const uint8x16_t level = vld1q_u8(neighbour);
    brighter = vrhaddq_u8(brighter, vcgtq_u8(level, high));
    above_low = vrhaddq_u8(above_low, vcgtq_u8(level, low));
  }
  vst1q_u8(row.brighter + x, brighter);
  // Nothing is darker than black by the dead zone.
  vst1q_u8(row.darker + x, vbicq_u8(vcgeq_u8(centre, vdupq_n_u8(row.dead_zone)), above_low));
}

void census_row(const CensusRow& row) {
  const CensusRow local = row;
  for (int x = 0; x < local.width; x += kBytes) census_16(local, x);
}

uint8x16_t smooth(uint8x16_t before, uint8x16_t here, uint8x16_t after) {
  return vrhaddq_u8(vrhaddq_u8(before, after), here);
}

// Two pixels' codes as 16 bytes of 0 or 255.
uint8x16_t spread_bits(const std::uint8_t* codes) {
  const uint8x8_t bit = vcreate_u8(0x8040'2010'0804'0201ULL);
  return vtstq_u8(vcombine_u8(vld1_dup_u8(codes), vld1_dup_u8(codes + 1)), vcombine_u8(bit, bit));
}

// Two pixels' planes: 255 brighter, 0 darker, 128 neither.
uint8x16_t spread(const std::uint8_t* brighter, const std::uint8_t* darker) {
  return vrhaddq_u8(spread_bits(brighter), vmvnq_u8(spread_bits(darker)));
}

void smooth_down_row(const DownRow& row) {
  const DownRow local = row;
  for (int x = 0; x < local.width; x += 2) {
    const int i = x * kPlaneCount;
    uint8x16_t m = spread(local.brighter + x, local.darker + x);
    for (int pass = 0; pass < 3; ++pass) {
      const uint8x16_t out =
          smooth(vld1q_u8(local.older[pass] + i), vld1q_u8(local.newer[pass] + i), m);
      vst1q_u8(local.older[pass] + i, m);
      m = out;
    }
    vst1q_u8(local.out + i, m);
  }
}

// One pass along the row, two pixels at a time.
struct AlongPass {
  uint8x16_t here = vdupq_n_u8(0);    // pixels 2k, 2k + 1
  uint8x16_t before = vdupq_n_u8(0);  // their left neighbours

  // Takes the next two pixels in and gives the smoothed ones before them.
  uint8x16_t push(uint8x16_t next) {
    const uint8x16_t after = vextq_u8(here, next, kPlaneCount);
    const uint8x16_t smoothed = smooth(before, here, after);
    before = after;  // what lies right of these two lies left of the next
    here = next;
    return smoothed;
  }
};

// The three passes in one, each two pixels behind the one before: that is six, the last three of
// which are read from the margin but have no weight.
void smooth_along_row(const AlongRow& row) {
  const AlongRow local = row;
  AlongPass passes[3];
  const auto push = [&passes, &local](int x) {
    const uint8x16_t in = vld1q_u8(local.in + x * kPlaneCount);
    return passes[2].push(passes[1].push(passes[0].push(in)));
  };
  for (int x = -4; x < 6; x += 2) push(x);
  int x = 0;
  for (; x + 2 <= local.width; x += 2) vst1q_u8(local.out + x * kPlaneCount, push(x + 6));
  if (x == local.width) return;
  vst1_u8(local.out + x * kPlaneCount, vget_low_u8(push(x + 6)));
}

}  // namespace

void bit_planes_neon(ImageView<const std::uint8_t> grey, int dead_zone,
                     ImageView<std::uint8_t> codes, std::span<std::uint8_t> scratch,
                     ImageView<std::uint8_t> planes) {
  bit_planes_by_rows(grey, dead_zone, codes, scratch, planes,
                     {blur_row, census_row, smooth_down_row, smooth_along_row});
}

}  // namespace darkling
