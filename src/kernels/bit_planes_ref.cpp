// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "kernels/bit_planes.h"

namespace darkling {

namespace {

// The eight bits of every code, bit c to byte c, as 0 or 1.
struct SpreadTable {
  std::uint8_t bytes[256][kPlaneCount];
  constexpr SpreadTable() : bytes() {
    for (int code = 0; code < 256; ++code) {
      for (int c = 0; c < kPlaneCount; ++c) {
        bytes[code][c] = static_cast<std::uint8_t>((code >> c) & 1);
      }
    }
  }
};
constexpr SpreadTable kSpread;

// Column sums of bits, at most 64 · 1, scaled to 0…255 with half up: s · 255 / 64.
std::uint8_t to_grey(unsigned sum) {
  return static_cast<std::uint8_t>((sum * 255 + 32) >> 6);
}

void smooth_column(ImageView<const std::uint8_t> codes, const SmoothingTaps& taps, int y,
                   std::uint8_t* out) {
  for (int x = 0; x < codes.width; ++x) {
    unsigned sum[kPlaneCount] = {};
    for (int k = -taps.radius; k <= taps.radius; ++k) {
      const int row = std::clamp(y + k, 0, codes.height - 1);
      const std::uint8_t* bits = kSpread.bytes[codes.at(x, row)];
      const unsigned w = taps.w[std::abs(k)];
      for (int c = 0; c < kPlaneCount; ++c) sum[c] += w * bits[c];
    }
    for (int c = 0; c < kPlaneCount; ++c) out[x * kPlaneCount + c] = to_grey(sum[c]);
  }
}

}  // namespace

void bit_planes_ref(ImageView<const std::uint8_t> codes, const SmoothingTaps& taps,
                    std::uint8_t* scratch, ImageView<std::uint8_t> dst) {
  constexpr int kMargin = SmoothingTaps::kMaxRadius * kPlaneCount;
  const int row_bytes = codes.width * kPlaneCount;
  std::uint8_t* row = scratch + kMargin;
  for (int y = 0; y < codes.height; ++y) {
    smooth_column(codes, taps, y, row);
    for (int k = 1; k <= SmoothingTaps::kMaxRadius; ++k) {
      std::memcpy(row - k * kPlaneCount, row, kPlaneCount);
      std::memcpy(row + row_bytes + (k - 1) * kPlaneCount, row + row_bytes - kPlaneCount,
                  kPlaneCount);
    }
    std::uint8_t* out = dst.row(y);
    for (int i = 0; i < row_bytes; ++i) {
      unsigned sum = 32 + taps.w[0] * row[i];
      for (int k = 1; k <= taps.radius; ++k) {
        sum += taps.w[k] * (row[i - k * kPlaneCount] + row[i + k * kPlaneCount]);
      }
      out[i] = static_cast<std::uint8_t>(sum >> 6);
    }
  }
}

}  // namespace darkling
