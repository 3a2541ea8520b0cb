// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/check.h"
#include "kernels/census.h"
#include "kernels/census_row.h"

namespace darkling {
namespace {

std::uint8_t bit(std::uint8_t neighbour, std::uint8_t centre, int index) {
  return static_cast<std::uint8_t>(neighbour > centre ? 1 << index : 0);
}

// The code at column x whose left and right neighbours stand in columns `left` and `right`.
// One byte-wide term a neighbour: so written, a loop over it compiles to 16 pixels a step.
std::uint8_t code_at(const CensusRow& row, int left, int x, int right) {
  const std::uint8_t c = row.centre[x];
  return bit(row.above[left], c, 0) | bit(row.above[x], c, 1) | bit(row.above[right], c, 2) |
         bit(row.centre[left], c, 3) | bit(row.centre[right], c, 4) | bit(row.below[left], c, 5) |
         bit(row.below[x], c, 6) | bit(row.below[right], c, 7);
}

void write_row(const CensusRow& row) {
  const CensusRow local = row;  // else each code written might have moved the pointers
  std::uint8_t* __restrict codes = row.codes;
  for (int x = 1; x < local.width - 1; ++x) codes[x] = code_at(local, x - 1, x, x + 1);
  census_columns(row, 0, 1);
  census_columns(row, row.width - 1, row.width);
}

}  // namespace

void census_columns(const CensusRow& row, int first, int last) {
  for (int x = first; x < last; ++x) {
    row.codes[x] = code_at(row, std::max(x - 1, 0), x, std::min(x + 1, row.width - 1));
  }
}

void census_by_rows(const ImageView<const std::uint8_t>& src, const ImageView<std::uint8_t>& dst,
                    CensusRowFn* write_codes) {
  CHECK(!src.is_empty(), "census needs at least one pixel");
  CHECK(have_same_size(src, dst), "census writes one code a pixel");
  for (int y = 0; y < src.height; ++y) {
    write_codes({.above = src.row(std::max(y - 1, 0)),
                 .centre = src.row(y),
                 .below = src.row(std::min(y + 1, src.height - 1)),
                 .codes = dst.row(y),
                 .width = src.width});
  }
}

void census_ref(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  census_by_rows(src, dst, write_row);
}

}  // namespace darkling
