// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstring>

#include "kernels/semi_global.h"

namespace darkling {

void hamming_row_ref(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
                     int disparities, std::span<std::uint8_t> cost) {
  std::uint8_t* out = cost.data();
  for (int x = 0; x < static_cast<int>(left.size()); ++x, out += disparities) {
    const int reach = std::min(disparities, x + 1);
    for (int d = 0; d < reach; ++d) {
      out[d] = static_cast<std::uint8_t>(
          std::popcount(static_cast<std::uint8_t>(left[x] ^ right[x - d])));
    }
    std::fill(out + reach, out + disparities, std::uint8_t{8});
  }
}

namespace {

// One step along one path: from the costs `before` (guarded by 255) with minimum `least` to `now`,
// whose minimum is returned; adds to `sum`. Hirschmüller 2008, eq. (13).
std::uint8_t step_path(std::span<const std::uint8_t> cost, SemiGlobalPenalties penalties,
                       const std::uint8_t* before, std::uint8_t least, std::uint8_t* now,
                       std::uint16_t* sum) {
  const int jump = least + penalties.large_step;
  std::uint8_t minimum = 255;
  for (int d = 0; d < static_cast<int>(cost.size()); ++d) {
    const int stay = before[d];
    const int step = std::min(before[d - 1], before[d + 1]) + penalties.small_step;
    const auto path =
        static_cast<std::uint8_t>(cost[d] + std::min(std::min(stay, step), jump) - least);
    now[d] = path;
    sum[d] = static_cast<std::uint16_t>(sum[d] + path);
    minimum = std::min(minimum, path);
  }
  return minimum;
}

}  // namespace

void reset_path_rows(PathRows& rows) {
  const int stride = rows.disparities + 2 * kPathGuard;
  for (int direction = 0; direction < 3; ++direction) {
    for (int parity = 0; parity < 2; ++parity) {
      std::memset(rows.costs[direction][parity], 255,
                  path_costs_bytes(rows.width, rows.disparities));
      std::memset(rows.minima[direction][parity], 0, path_minima_bytes(rows.width));
      for (int x = 0; x < rows.width + 2; ++x) {
        std::memset(rows.costs[direction][parity] + x * stride + kPathGuard, 0, rows.disparities);
      }
    }
  }
  rows.parity = 0;
}

void semi_global_row_ref(std::span<const std::uint8_t> cost, SemiGlobalPenalties penalties,
                         PathRows& rows, std::span<std::uint16_t> sum) {
  const int D = rows.disparities;
  const int stride = D + 2 * kPathGuard;
  const int before = rows.parity;
  const int now = 1 - rows.parity;
  std::memset(rows.along, 255, path_along_bytes(D));
  std::uint8_t* along[2] = {rows.along + kPathGuard, rows.along + stride + kPathGuard};
  std::fill(sum.begin(), sum.end(), std::uint16_t{0});

  std::memset(along[0], 0, D);
  std::uint8_t least_along = 0;
  for (int x = 0; x < rows.width; ++x) {
    const std::span<const std::uint8_t> c = cost.subspan(x * D, D);
    std::uint16_t* s = sum.data() + x * D;
    for (int direction = 0; direction < 3; ++direction) {
      const int from = x + 1 + direction - 1;  // one guard pixel at the left end
      const int to = x + 1;
      rows.minima[direction][now][to] =
          step_path(c, penalties, rows.costs[direction][before] + from * stride + kPathGuard,
                    rows.minima[direction][before][from],
                    rows.costs[direction][now] + to * stride + kPathGuard, s);
    }
    least_along = step_path(c, penalties, along[x & 1], least_along, along[1 - (x & 1)], s);
  }

  std::memset(along[0], 0, D);
  least_along = 0;
  int side = 0;
  for (int x = rows.width - 1; x >= 0; --x, side = 1 - side) {
    least_along = step_path(cost.subspan(x * D, D), penalties, along[side], least_along,
                            along[1 - side], sum.data() + x * D);
  }
  rows.parity = now;
}

}  // namespace darkling
