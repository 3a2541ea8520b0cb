// SPDX-License-Identifier: Apache-2.0
#include <immintrin.h>

#include "kernels/census.h"
#include "kernels/census_row.h"

namespace darkling {
namespace {

constexpr int kVector = 32;  // pixels

// Grey levels with the top bit flipped, for a comparison that knows only signed bytes.
__m256i load(const std::uint8_t* pixels) {
  const __m256i top_bit = _mm256_set1_epi8(-128);
  return _mm256_xor_si256(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels)), top_bit);
}

// Moves the codes one bit down and puts the next neighbour's bit on top. A rounded average with a
// mask of 0 or 255 does both, without rounding: seven moves leave the lowest bit clear.
__m256i push_bit(__m256i codes, __m256i neighbour, __m256i centre) {
  return _mm256_avg_epu8(codes, _mm256_cmpgt_epi8(neighbour, centre));
}

void write_codes(const CensusRow& row, int x) {
  const __m256i c = load(row.centre + x);
  __m256i codes = _mm256_setzero_si256();
  codes = push_bit(codes, load(row.above + x - 1), c);
  codes = push_bit(codes, load(row.above + x), c);
  codes = push_bit(codes, load(row.above + x + 1), c);
  codes = push_bit(codes, load(row.centre + x - 1), c);
  codes = push_bit(codes, load(row.centre + x + 1), c);
  codes = push_bit(codes, load(row.below + x - 1), c);
  codes = push_bit(codes, load(row.below + x), c);
  codes = push_bit(codes, load(row.below + x + 1), c);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(row.codes + x), codes);
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

void census_avx2(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  census_by_rows(src, dst, write_row);
}

}  // namespace darkling
