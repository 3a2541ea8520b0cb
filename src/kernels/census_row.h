// SPDX-License-Identifier: Apache-2.0
// What every variant of the census transform shares: the walk over rows and the columns that no
// vector fits. Nothing here is inline, so that no code of a wider instruction set can leak out of
// the variant's own file.
#pragma once

#include <cstdint>

#include "kernels/census.h"

namespace darkling {

// One row of codes to write and the three rows of pixels they depend on (at the top and bottom
// border two of them are the same).
struct CensusRow {
  const std::uint8_t* above;
  const std::uint8_t* centre;
  const std::uint8_t* below;
  std::uint8_t* codes;
  int width;  // px
};

// Writes the codes of one whole row.
using CensusRowFn = void(const CensusRow& row);

// Calls `write_codes` for each row of the image.
void census_by_rows(const ImageView<const std::uint8_t>& src, const ImageView<std::uint8_t>& dst,
                    CensusRowFn* write_codes);

// The codes of columns [first, last), one pixel at a time, with replication at both ends of the
// row.
void census_columns(const CensusRow& row, int first, int last);

}  // namespace darkling
