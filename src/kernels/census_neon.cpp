// SPDX-License-Identifier: Apache-2.0
#include <arm_neon.h>

#include "kernels/census.h"
#include "kernels/census_row.h"

namespace darkling {
namespace {

constexpr int kVector = 16;  // pixels

// Moves the codes one bit down and puts the next neighbour's bit on top.
uint8x16_t push_bit(uint8x16_t codes, const std::uint8_t* neighbour, uint8x16_t centre) {
  return vsriq_n_u8(vcgtq_u8(vld1q_u8(neighbour), centre), codes, 1);
}

void write_codes(const CensusRow& row, int x) {
  const uint8x16_t c = vld1q_u8(row.centre + x);
  uint8x16_t codes = vdupq_n_u8(0);
  codes = push_bit(codes, row.above + x - 1, c);
  codes = push_bit(codes, row.above + x, c);
  codes = push_bit(codes, row.above + x + 1, c);
  codes = push_bit(codes, row.centre + x - 1, c);
  codes = push_bit(codes, row.centre + x + 1, c);
  codes = push_bit(codes, row.below + x - 1, c);
  codes = push_bit(codes, row.below + x, c);
  codes = push_bit(codes, row.below + x + 1, c);
  vst1q_u8(row.codes + x, codes);
}

void write_row(const CensusRow& row) {
  const int last = row.width - 1;
  if (last - 1 < kVector) {
    census_columns(row, 0, row.width);
    return;
  }
  const CensusRow local = row;  // else each code written might have moved the pointers
  for (int x = 1; x + kVector <= last; x += kVector) write_codes(local, x);
  write_codes(local, last - kVector);  // overlaps the one before: no read goes past the row
  census_columns(row, 0, 1);
  census_columns(row, last, row.width);
}

}  // namespace

void census_neon(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  census_by_rows(src, dst, write_row);
}

}  // namespace darkling
