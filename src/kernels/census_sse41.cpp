// SPDX-License-Identifier: Apache-2.0
#include <smmintrin.h>

#include "kernels/census.h"
#include "kernels/census_row.h"

namespace darkling {
namespace {

constexpr int kVector = 16;  // pixels

// Grey levels with the top bit flipped, for a comparison that knows only signed bytes.
__m128i load(const std::uint8_t* pixels) {
  const __m128i top_bit = _mm_set1_epi8(-128);
  return _mm_xor_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(pixels)), top_bit);
}

// Moves the codes one bit down and puts the next neighbour's bit on top. A rounded average with a
// mask of 0 or 255 does both, without rounding: seven moves leave the lowest bit clear.
__m128i push_bit(__m128i codes, __m128i neighbour, __m128i centre) {
  return _mm_avg_epu8(codes, _mm_cmpgt_epi8(neighbour, centre));
}

void write_codes(const CensusRow& row, int x) {
  const __m128i c = load(row.centre + x);
  __m128i codes = _mm_setzero_si128();
  codes = push_bit(codes, load(row.above + x - 1), c);
  codes = push_bit(codes, load(row.above + x), c);
  codes = push_bit(codes, load(row.above + x + 1), c);
  codes = push_bit(codes, load(row.centre + x - 1), c);
  codes = push_bit(codes, load(row.centre + x + 1), c);
  codes = push_bit(codes, load(row.below + x - 1), c);
  codes = push_bit(codes, load(row.below + x), c);
  codes = push_bit(codes, load(row.below + x + 1), c);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(row.codes + x), codes);
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

void census_sse41(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  census_by_rows(src, dst, write_row);
}

}  // namespace darkling
