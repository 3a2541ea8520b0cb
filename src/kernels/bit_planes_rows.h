// SPDX-License-Identifier: Apache-2.0
// What every variant of bit_planes shares: the walk over rows. A variant brings the four row
// functions. Nothing here is inline, so that no code of a wider instruction set can leak out of the
// variant's own file.
#pragma once

#include <cstdint>

#include "kernels/bit_planes.h"

namespace darkling {

// One row of step 1 of the contract: blurred[x], x in 0…width - 1.
struct BlurRow {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
  std::uint8_t* blurred;
  int width;  // px
};

// One row of step 2. All three rows can be read one pixel beyond both ends, and a vector beyond
// that; as much may be written behind the last code.
struct CensusRow {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
  std::uint8_t* brighter;
  std::uint8_t* darker;
  int width;  // px
  std::uint8_t dead_zone;
};

// One row through steps 3 and 4, down the columns. Each of the three passes of the smoothing
// remembers two rows: with m the row that comes in, every pass computes
//   out = avg(avg(older, m), newer),  older ← m  (the caller then exchanges the two),
// which is the row before m, and hands it on to the next. Rows may be written a vector beyond.
struct DownRow {
  const std::uint8_t* brighter;  // codes
  const std::uint8_t* darker;
  std::uint8_t* older[3];
  const std::uint8_t* newer[3];
  std::uint8_t* out;
  int width;  // px
};

// The rest of step 4 for one row: three passes along it. `in` holds three pixels of margin at both
// ends. Exactly 8 · width bytes of `out` are written; of the others, a vector beyond may be.
struct AlongRow {
  std::uint8_t* in;     // is overwritten
  std::uint8_t* spare;  // as large
  std::uint8_t* out;
  int width;  // px
};

struct BitPlanesRows {
  void (*blur)(const BlurRow& row);
  void (*census)(const CensusRow& row);
  void (*smooth_down)(const DownRow& row);
  void (*smooth_along)(const AlongRow& row);
};

// Does what BitPlanesFn promises, by rows.
void bit_planes_by_rows(const ImageView<const std::uint8_t>& grey, int dead_zone,
                        const ImageView<std::uint8_t>& codes,
                        const std::span<std::uint8_t>& scratch,
                        const ImageView<std::uint8_t>& planes, const BitPlanesRows& rows);

// Columns [first, last) of a blurred row, one at a time, with replication at both ends.
void blur_columns(const BlurRow& row, int first, int last);

// One pass of smoothing along: out[i] for i in [first, last) from in[i - 8], in[i], in[i + 8].
void smooth_along_bytes(const std::uint8_t* in, std::uint8_t* out, int first, int last);

}  // namespace darkling
