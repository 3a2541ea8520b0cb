// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "kernels/bit_planes.h"
#include "kernels/bit_planes_rows.h"

namespace darkling {
namespace {

constexpr int kPasses = 3;

std::uint8_t average(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) >> 1);
}

std::uint8_t blur_at(const BlurRow& row, int left, int x, int right) {
  const auto column = [&row](int i) { return row.above[i] + 2 * row.here[i] + row.below[i]; };
  return static_cast<std::uint8_t>((column(left) + 2 * column(x) + column(right) + 8) >> 4);
}

void blur_row(const BlurRow& row) {
  const BlurRow local = row;
  std::uint8_t* __restrict blurred = row.blurred;
  for (int x = 1; x < local.width - 1; ++x) blurred[x] = blur_at(local, x - 1, x, x + 1);
  blur_columns(row, 0, 1);
  blur_columns(row, row.width - 1, row.width);
}

// One byte-wide term a neighbour: so written, the loop over it compiles to vectors.
std::uint8_t bit(std::uint8_t neighbour, std::uint8_t level, int index) {
  return static_cast<std::uint8_t>(neighbour > level ? 1 << index : 0);
}

void census_row(const CensusRow& row) {
  const CensusRow local = row;
  std::uint8_t* __restrict brighter = row.brighter;
  std::uint8_t* __restrict darker = row.darker;
  for (int x = 0; x < local.width; ++x) {
    const int c = local.here[x];
    const auto high = static_cast<std::uint8_t>(std::min(c + local.dead_zone, 255));
    brighter[x] = bit(local.above[x - 1], high, 0) | bit(local.above[x], high, 1) |
                  bit(local.above[x + 1], high, 2) | bit(local.here[x - 1], high, 3) |
                  bit(local.here[x + 1], high, 4) | bit(local.below[x - 1], high, 5) |
                  bit(local.below[x], high, 6) | bit(local.below[x + 1], high, 7);
    if (c < local.dead_zone) {
      darker[x] = 0;
      continue;
    }
    const auto low = static_cast<std::uint8_t>(c - local.dead_zone);
    darker[x] = static_cast<std::uint8_t>(
        ~(bit(local.above[x - 1], low, 0) | bit(local.above[x], low, 1) |
          bit(local.above[x + 1], low, 2) | bit(local.here[x - 1], low, 3) |
          bit(local.here[x + 1], low, 4) | bit(local.below[x - 1], low, 5) |
          bit(local.below[x], low, 6) | bit(local.below[x + 1], low, 7)));
  }
}

// The eight bits of every code, bit c to byte c, as 0 or 255.
struct SpreadTable {
  std::uint8_t bytes[256][kPlaneCount];
  constexpr SpreadTable() : bytes() {
    for (int code = 0; code < 256; ++code) {
      for (int c = 0; c < kPlaneCount; ++c) {
        bytes[code][c] = (code >> c & 1) != 0 ? 255 : 0;
      }
    }
  }
};
constexpr SpreadTable kSpread;

// 255 brighter, 0 darker, 128 neither.
void spread(const std::uint8_t* brighter, const std::uint8_t* darker, int width,
            std::uint8_t* planes) {
  for (int x = 0; x < width; ++x) {
    const std::uint8_t* high = kSpread.bytes[brighter[x]];
    const std::uint8_t* low = kSpread.bytes[darker[x]];
    for (int c = 0; c < kPlaneCount; ++c) {
      planes[x * kPlaneCount + c] = average(high[c], static_cast<std::uint8_t>(~low[c]));
    }
  }
}

void smooth_down_row(const DownRow& row) {
  const int width = row.width;  // a byte that is written might have been part of it
  spread(row.brighter, row.darker, width, row.out);
  for (int pass = 0; pass < kPasses; ++pass) {
    std::uint8_t* __restrict out = row.out;
    std::uint8_t* __restrict older = row.older[pass];
    const std::uint8_t* __restrict newer = row.newer[pass];
    for (int i = 0; i < width * kPlaneCount; ++i) {
      const std::uint8_t m = out[i];
      out[i] = average(average(older[i], m), newer[i]);
      older[i] = m;
    }
  }
}

void smooth_along_row(const AlongRow& row) {
  const int bytes = row.width * kPlaneCount;
  smooth_along_bytes(row.in, row.spare, -2 * kPlaneCount, bytes + 2 * kPlaneCount);
  smooth_along_bytes(row.spare, row.in, -kPlaneCount, bytes + kPlaneCount);
  smooth_along_bytes(row.in, row.out, 0, bytes);
}

// Hands out the scratch, row by row.
class ScratchRows {
 public:
  ScratchRows(std::span<std::uint8_t> scratch, int width)
      : next_(scratch.data()), pixels_((width + 63) / 64 * 64) {}
  std::uint8_t* take(int bytes_a_pixel) {
    std::uint8_t* row = next_ + kPlanesMargin;
    next_ += bytes_a_pixel * pixels_ + 2 * kPlanesMargin;
    return row;
  }

 private:
  std::uint8_t* next_;
  int pixels_;
};

// The three newest rows of the blurred image, each with a pixel of margin.
class BlurredRows {
 public:
  BlurredRows(const ImageView<const std::uint8_t>& grey, ScratchRows& scratch,
              void (*blur)(const BlurRow& row))
      : grey_(grey), blur_(blur) {
    for (std::uint8_t*& row : rows_) row = scratch.take(1);
  }
  // @pre called for y in order, from 0.
  void compute(int y) {
    const int last = grey_.height - 1;
    std::uint8_t* row = at(y);
    blur_({grey_.row(std::max(y - 1, 0)), grey_.row(y), grey_.row(std::min(y + 1, last)), row,
           grey_.width});
    row[-1] = row[0];
    row[grey_.width] = row[grey_.width - 1];
  }
  [[nodiscard]] std::uint8_t* at(int y) const { return rows_[y % 3]; }

 private:
  const ImageView<const std::uint8_t>& grey_;
  void (*blur_)(const BlurRow& row);
  std::uint8_t* rows_[3] = {};
};

// Steps 3 and 4: takes rows of codes in, and gives rows of planes out kPasses rows later.
class SmoothedPlanes {
 public:
  SmoothedPlanes(int width, ScratchRows& scratch, const BitPlanesRows& rows)
      : rows_(rows),
        in_(scratch.take(kPlaneCount)),
        spare_(scratch.take(kPlaneCount)),
        width_(width) {
    for (std::uint8_t*& row : older_) row = scratch.take(kPlaneCount);
    for (std::uint8_t*& row : newer_) row = scratch.take(kPlaneCount);
  }

  // The first row of codes; those above it count as equal.
  void start(const std::uint8_t* brighter, const std::uint8_t* darker) {
    spread(brighter, darker, width_, in_);
    for (std::uint8_t* row : older_) std::memcpy(row, in_, width_ * kPlaneCount);
    for (std::uint8_t* row : newer_) std::memcpy(row, in_, width_ * kPlaneCount);
  }

  void push(const std::uint8_t* brighter, const std::uint8_t* darker) {
    rows_.smooth_down({brighter,
                       darker,
                       {older_[0], older_[1], older_[2]},
                       {newer_[0], newer_[1], newer_[2]},
                       in_,
                       width_});
    for (int pass = 0; pass < kPasses; ++pass) std::swap(older_[pass], newer_[pass]);
  }

  // The row that was pushed kPasses rows ago.
  void finish(std::uint8_t* out) {
    const int bytes = width_ * kPlaneCount;
    for (int k = 0; k < kPasses; ++k) {
      std::memcpy(in_ - (k + 1) * kPlaneCount, in_, kPlaneCount);
      std::memcpy(in_ + bytes + k * kPlaneCount, in_ + bytes - kPlaneCount, kPlaneCount);
    }
    rows_.smooth_along({in_, spare_, out, width_});
  }

 private:
  const BitPlanesRows& rows_;
  std::uint8_t* in_;
  std::uint8_t* spare_;
  std::uint8_t* older_[kPasses] = {};
  std::uint8_t* newer_[kPasses] = {};
  int width_;
};

}  // namespace

void blur_columns(const BlurRow& row, int first, int last) {
  for (int x = first; x < last; ++x) {
    row.blurred[x] = blur_at(row, std::max(x - 1, 0), x, std::min(x + 1, row.width - 1));
  }
}

void smooth_along_bytes(const std::uint8_t* in, std::uint8_t* out, int first, int last) {
  const std::uint8_t* __restrict from = in;
  std::uint8_t* __restrict to = out;
  for (int i = first; i < last; ++i) {
    to[i] = average(average(from[i - kPlaneCount], from[i + kPlaneCount]), from[i]);
  }
}

void bit_planes_by_rows(const ImageView<const std::uint8_t>& grey, int dead_zone,
                        const ImageView<std::uint8_t>& codes,
                        const std::span<std::uint8_t>& scratch,
                        const ImageView<std::uint8_t>& planes, const BitPlanesRows& rows) {
  CHECK(!grey.is_empty(), "bit-planes need at least one pixel");
  CHECK(dead_zone >= 0 && dead_zone <= 255, "the dead zone is a grey level");
  CHECK(planes.data == nullptr || planes.has_size(kPlaneCount * grey.width, grey.height),
        "eight bytes of planes a pixel");
  CHECK(codes.data == nullptr || have_same_size(grey, codes), "one census code a pixel");
  CHECK(scratch.size() >= bit_planes_scratch_bytes(grey.width), "the scratch is too small");
  const int width = grey.width;
  const int last = grey.height - 1;
  ScratchRows memory(scratch, width);
  BlurredRows blurred(grey, memory, rows.blur);
  std::uint8_t* brighter = memory.take(1);
  std::uint8_t* darker = memory.take(1);
  SmoothedPlanes smoothed(width, memory, rows);
  blurred.compute(0);
  // Beyond the last row of codes, it stands again.
  for (int y = 0; y <= (planes.data != nullptr ? last + kPasses : last); ++y) {
    if (y <= last) {
      if (y < last) blurred.compute(y + 1);
      rows.census({blurred.at(std::max(y - 1, 0)), blurred.at(y), blurred.at(std::min(y + 1, last)),
                   brighter, darker, width, static_cast<std::uint8_t>(dead_zone)});
      if (codes.data != nullptr) std::memcpy(codes.row(y), brighter, width);
    }
    if (planes.data == nullptr) continue;
    if (y == 0) smoothed.start(brighter, darker);
    if (y > 0) smoothed.push(brighter, darker);
    if (y >= kPasses) smoothed.finish(planes.row(y - kPasses));
  }
}

void bit_planes_ref(ImageView<const std::uint8_t> grey, int dead_zone,
                    ImageView<std::uint8_t> codes, std::span<std::uint8_t> scratch,
                    ImageView<std::uint8_t> planes) {
  bit_planes_by_rows(grey, dead_zone, codes, scratch, planes,
                     {blur_row, census_row, smooth_down_row, smooth_along_row});
}

}  // namespace darkling
