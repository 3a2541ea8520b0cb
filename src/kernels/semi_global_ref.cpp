// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstring>

#include "kernels/semi_global.h"

namespace darkling {

namespace {

constexpr int kD = kDisparities;

// One step along one path: from the costs `before` (guarded by 255) with minimum `least` to `now`,
// whose minimum is returned; adds to `sum`. Hirschmüller 2008, eq. (13).
std::uint8_t step_path(const std::uint8_t* cost, SemiGlobalPenalties penalties,
                       const std::uint8_t* before, std::uint8_t least, std::uint8_t* now,
                       std::uint16_t* sum) {
  const int jump = least + penalties.large_step;
  std::uint8_t minimum = 255;
  for (int d = 0; d < kD; ++d) {
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

// The path along the row: two pixels' costs, in turns.
class PathAlong {
 public:
  PathAlong() { std::memset(costs_, 255, sizeof(costs_)); }
  void start() {
    std::memset(costs_[now_] + kPathGuard, 0, kD);
    least_ = 0;
  }
  void step(const std::uint8_t* cost, SemiGlobalPenalties penalties, std::uint16_t* sum) {
    const std::uint8_t* before = costs_[now_] + kPathGuard;
    now_ = 1 - now_;
    least_ = step_path(cost, penalties, before, least_, costs_[now_] + kPathGuard, sum);
  }

 private:
  std::uint8_t costs_[2][kPathStride];
  std::uint8_t least_ = 0;
  int now_ = 0;
};

void sum_window(const std::uint8_t* const hamming[3], int width, std::uint8_t* cost) {
  for (int x = 0; x < width; ++x) {
    const int columns[3] = {std::max(x - 1, 0), x, std::min(x + 1, width - 1)};
    for (int d = 0; d < kD; ++d) {
      int sum = 0;
      for (const int column : columns) {
        for (int j = 0; j < 3; ++j) sum += hamming[j][column * kD + d];
      }
      cost[x * kD + d] = static_cast<std::uint8_t>(sum);
    }
  }
}

void choose_winners(int width, const StereoRow& row) {
  std::fill_n(row.right_winner, width, std::uint16_t{0xffff});
  for (int x = 0; x < width; ++x) {
    std::uint16_t best = 0xffff;
    for (int d = 0; d < std::min(kD, x + 1); ++d) {
      const auto key = static_cast<std::uint16_t>(row.sum[x * kD + d] * kD + d);
      std::uint16_t& right = row.right_winner[width - 1 - x + d];
      right = std::min(right, key);
      best = std::min(best, key);
    }
    row.left_winner[x] = best;
  }
}

}  // namespace

void hamming_row_ref(const std::uint8_t* left, const std::uint8_t* right_reversed, int width,
                     std::uint8_t* cost) {
  for (int x = 0; x < width; ++x) {
    const std::uint8_t* right = right_reversed + width - 1 - x;
    std::uint8_t* out = cost + x * kD;
    for (int d = 0; d < kD; ++d) {
      const auto differ = static_cast<std::uint8_t>(left[x] ^ right[d]);
      out[d] = static_cast<std::uint8_t>(d > x ? 8 : std::popcount(differ));
    }
  }
}

void reset_path_rows(PathRows& rows) {
  for (int direction = 0; direction < 3; ++direction) {
    for (int parity = 0; parity < 2; ++parity) {
      std::uint8_t* costs = rows.costs[direction][parity];
      std::memset(costs, 255, path_costs_bytes(rows.width));
      std::memset(rows.minima[direction][parity], 0, path_minima_bytes(rows.width));
      for (int x = 0; x < rows.width + 2; ++x) {
        std::memset(costs + x * kPathStride + kPathGuard, 0, kD);
      }
    }
  }
  rows.parity = 0;
}

void semi_global_row_ref(const std::uint8_t* const hamming[3], SemiGlobalPenalties penalties,
                         PathRows& paths, const StereoRow& row) {
  const int width = paths.width;
  const int before = paths.parity;
  const int now = 1 - paths.parity;
  sum_window(hamming, width, row.cost);
  std::fill_n(row.sum, width * kD, std::uint16_t{0});

  PathAlong along;
  along.start();
  for (int x = 0; x < width; ++x) {
    for (int direction = 0; direction < 3; ++direction) {
      const int from = x + direction;  // a guard pixel at the left end: x - 1, x, x + 1
      const int to = x + 1;
      paths.minima[direction][now][to] =
          step_path(row.cost + x * kD, penalties,
                    paths.costs[direction][before] + from * kPathStride + kPathGuard,
                    paths.minima[direction][before][from],
                    paths.costs[direction][now] + to * kPathStride + kPathGuard, row.sum + x * kD);
    }
    along.step(row.cost + x * kD, penalties, row.sum + x * kD);
  }
  along.start();
  for (int x = width - 1; x >= 0; --x) along.step(row.cost + x * kD, penalties, row.sum + x * kD);
  choose_winners(width, row);
  paths.parity = now;
}

}  // namespace darkling
