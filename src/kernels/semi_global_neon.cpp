// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/semi_global.h"

// All disparities of a pixel are two vectors.

namespace darkling {
namespace {

constexpr int kD = kDisparities;
constexpr int kHalf = kD / 2;  // bytes of a vector

// A byte each for all disparities.
struct Bytes {
  uint8x16_t low;
  uint8x16_t high;
};

Bytes load_all(const std::uint8_t* from) {
  return {vld1q_u8(from), vld1q_u8(from + kHalf)};
}
void store_all(std::uint8_t* to, const Bytes& bytes) {
  vst1q_u8(to, bytes.low);
  vst1q_u8(to + kHalf, bytes.high);
}
Bytes add(const Bytes& a, const Bytes& b) {
  return {vaddq_u8(a.low, b.low), vaddq_u8(a.high, b.high)};
}

// The vectors that begin at kD - 1 - x are 255 where d > x.
struct BeyondTable {
  std::uint8_t bytes[2 * kD];
  constexpr BeyondTable() : bytes() {
    for (int i = 0; i < 2 * kD; ++i) bytes[i] = i < kD ? 0 : 255;
  }
};
constexpr BeyondTable kBeyond;

// 255 for the disparities that reach beyond the right image from column x.
Bytes beyond(int x) {
  return load_all(kBeyond.bytes + kD - 1 - (x < kD - 1 ? x : kD - 1));
}

// The least of eight pairs, neighbours in `bytes`.
uint8x8_t least_of_pairs(const Bytes& bytes) {
  const uint8x16_t sixteen = vminq_u8(bytes.low, bytes.high);
  return vpmin_u8(vget_low_u8(sixteen), vget_high_u8(sixteen));
}

struct Penalties {
  uint8x16_t small_step;
  uint8x16_t large_step;
};

// Hirschmüller 2008, eq. (13), for half the disparities. What saturates is never the least.
uint8x16_t step_half(uint8x16_t cost, const Penalties& p, uint8x16_t below, uint8x16_t stay,
                     uint8x16_t above, uint8x16_t least) {
  const uint8x16_t step = vqaddq_u8(vminq_u8(below, above), p.small_step);
  const uint8x16_t jump = vaddq_u8(least, p.large_step);
  const uint8x16_t best = vminq_u8(vminq_u8(stay, step), jump);
  return vaddq_u8(cost, vsubq_u8(best, least));
}

// The path along a row, kept in registers. Whoever steps also sets the least of the new costs.
struct PathAlong {
  Bytes costs = {vdupq_n_u8(0), vdupq_n_u8(0)};
  uint8x16_t least = vdupq_n_u8(0);

  void step(const Bytes& cost, const Penalties& p) {
    const uint8x16_t guard = vdupq_n_u8(255);
    const auto [low, high] = costs;
    costs.low =
        step_half(cost.low, p, vextq_u8(guard, low, 15), low, vextq_u8(low, high, 1), least);
    costs.high =
        step_half(cost.high, p, vextq_u8(low, high, 15), high, vextq_u8(high, guard, 1), least);
  }
};

// The costs of one pixel on one of the paths from above.
Bytes step_from_above(const Bytes& cost, const Penalties& p, const std::uint8_t* before,
                      const std::uint8_t* least_before, std::uint8_t* now) {
  const uint8x16_t least = vld1q_dup_u8(least_before);
  const auto half = [&](uint8x16_t c, const std::uint8_t* from) {
    return step_half(c, p, vld1q_u8(from - 1), vld1q_u8(from), vld1q_u8(from + 1), least);
  };
  const Bytes path = {half(cost.low, before), half(cost.high, before + kHalf)};
  store_all(now, path);
  return path;
}

// Hamming distances of one column of pixels, summed over the three rows.
Bytes sum_column(const std::uint8_t* const hamming[3], int x) {
  return add(add(load_all(hamming[0] + x * kD), load_all(hamming[1] + x * kD)),
             load_all(hamming[2] + x * kD));
}

// Bytes 8 i … 8 i + 7.
uint8x8_t eight(const Bytes& bytes, int i) {
  const uint8x16_t half = i < 2 ? bytes.low : bytes.high;
  return i % 2 == 0 ? vget_low_u8(half) : vget_high_u8(half);
}

// The four paths that have arrived when a row is walked from the left: matching costs, path costs
// for the row below, and the sum so far.
void walk_right(const std::uint8_t* const hamming[3], const Penalties& p, const PathRows& paths,
                const StereoRow& row) {
  const int width = paths.width;
  const int before = paths.parity;
  const int now = 1 - before;
  PathAlong along;
  Bytes left = sum_column(hamming, 0);
  Bytes here = left;
  for (int x = 0; x < width; ++x) {
    const Bytes right = sum_column(hamming, x + 1 < width ? x + 1 : x);
    const Bytes cost = add(add(left, here), right);
    left = here;
    here = right;
    store_all(row.cost + x * kD, cost);
    Bytes path[3];
    for (int direction = 0; direction < 3; ++direction) {
      const int from = x + direction;  // a guard pixel at the left end: x - 1, x, x + 1
      path[direction] =
          step_from_above(cost, p, paths.costs[direction][before] + from * kPathStride + kPathGuard,
                          paths.minima[direction][before] + from,
                          paths.costs[direction][now] + (x + 1) * kPathStride + kPathGuard);
    }
    along.step(cost, p);
    // The least of all four paths at once: four candidates each, then two, then one.
    uint8x8_t least = vpmin_u8(vpmin_u8(least_of_pairs(path[0]), least_of_pairs(path[1])),
                               vpmin_u8(least_of_pairs(path[2]), least_of_pairs(along.costs)));
    least = vpmin_u8(least, least);
    vst1_lane_u8(paths.minima[0][now] + x + 1, least, 0);
    vst1_lane_u8(paths.minima[1][now] + x + 1, least, 1);
    vst1_lane_u8(paths.minima[2][now] + x + 1, least, 2);
    along.least = vdupq_lane_u8(least, 3);
    for (int i = 0; i < 4; ++i) {
      vst1q_u16(row.sum + x * kD + 8 * i,
                vaddq_u16(vaddl_u8(eight(path[0], i), eight(path[1], i)),
                          vaddl_u8(eight(path[2], i), eight(along.costs, i))));
    }
  }
}

uint8x16_t least_everywhere(const Bytes& bytes) {
  uint8x8_t least = least_of_pairs(bytes);
  for (int i = 0; i < 3; ++i) least = vpmin_u8(least, least);
  return vcombine_u8(least, least);
}

void store_least(std::uint16_t* to, uint16x8_t words) {
  uint16x4_t least = vpmin_u16(vget_low_u16(words), vget_high_u16(words));
  for (int i = 0; i < 2; ++i) least = vpmin_u16(least, least);
  vst1_lane_u16(to, least, 0);
}

// Bytes of 0 or 255 as words of 0 or 65535.
uint16x8_t widen_mask(uint8x8_t mask) {
  return vreinterpretq_u16_s16(vmovl_s8(vreinterpret_s8_u8(mask)));
}

// The least keys of the right pixels that a left pixel's disparities reach, the nearest first. From
// one left pixel to the next they move on by one, and the nearest is complete. Kept in registers: a
// load from where other vectors have just been stored in part would wait for them.
struct RightWinners {
  uint16x8_t quarters[4];

  std::uint16_t take(const uint16x8_t keys[4]) {
    for (int i = 0; i < 4; ++i) quarters[i] = vminq_u16(quarters[i], keys[i]);
    const std::uint16_t nearest = vgetq_lane_u16(quarters[0], 0);
    for (int i = 0; i < 3; ++i) quarters[i] = vextq_u16(quarters[i], quarters[i + 1], 1);
    quarters[3] = vextq_u16(quarters[3], vdupq_n_u16(0xffff), 1);
    return nearest;
  }
};

// The fifth path, from the right, and the winners, now that all sums are there.
void walk_left(const Penalties& p, int width, const StereoRow& row) {
  const uint16x8_t first_d = vmovl_u8(vcreate_u8(0x0706'0504'0302'0100ULL));
  const uint16x8_t none = vdupq_n_u16(0xffff);
  RightWinners right = {{none, none, none, none}};
  PathAlong along;
  for (int x = width - 1; x >= 0; --x) {
    along.step(load_all(row.cost + x * kD), p);
    along.least = least_everywhere(along.costs);
    const Bytes outside = beyond(x);
    uint16x8_t least = none;
    uint16x8_t keys[4];
    for (int i = 0; i < 4; ++i) {
      std::uint16_t* to = row.sum + x * kD + 8 * i;
      const uint16x8_t sum = vaddw_u8(vld1q_u16(to), eight(along.costs, i));
      vst1q_u16(to, sum);
      const uint16x8_t d = vaddq_u16(first_d, vdupq_n_u16(static_cast<std::uint16_t>(8 * i)));
      keys[i] = vsliq_n_u16(d, sum, 5);
      least = vminq_u16(least, vorrq_u16(keys[i], widen_mask(eight(outside, i))));
    }
    row.right_winner[width - 1 - x] = right.take(keys);
    store_least(row.left_winner + x, least);
  }
}

}  // namespace

void hamming_row_neon(const std::uint8_t* left, const std::uint8_t* right_reversed, int width,
                      std::uint8_t* cost) {
  const uint8x16_t all = vdupq_n_u8(8);
  for (int x = 0; x < width; ++x) {
    const uint8x16_t code = vld1q_dup_u8(left + x);
    const Bytes right = load_all(right_reversed + width - 1 - x);
    const Bytes out = beyond(x);
    store_all(cost + x * kD, {vbslq_u8(out.low, all, vcntq_u8(veorq_u8(code, right.low))),
                              vbslq_u8(out.high, all, vcntq_u8(veorq_u8(code, right.high)))});
  }
}

void semi_global_row_neon(const std::uint8_t* const hamming[3], SemiGlobalPenalties penalties,
                          PathRows& paths, const StereoRow& row) {
  const Penalties p = {vdupq_n_u8(penalties.small_step), vdupq_n_u8(penalties.large_step)};
  walk_right(hamming, p, paths, row);
  walk_left(p, paths.width, row);
  paths.parity = 1 - paths.parity;
}

}  // namespace darkling
