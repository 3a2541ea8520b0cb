// SPDX-License-Identifier: Apache-2.0
#include "vo/match_stereo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vo/limits.h"

namespace darkling {

namespace {

constexpr int kWindowRadius = 1;
constexpr int kWindow = 2 * kWindowRadius + 1;
// In bits of the window's Hamming distance (8 a pixel, 72 in all).
constexpr SemiGlobalPenalties kPenalties = {.small_step = 8, .large_step = 32};

// Sums the Hamming rows about row y over the window, beyond the border the nearest row and column.
void sum_window(const StereoMatcher& m, int y, int height) {
  const int D = m.disparities;
  const int width = m.paths.width;
  const std::size_t row_size = std::size_t(width) * D;
  std::fill(m.column_sums.begin(), m.column_sums.end(), std::uint16_t{0});
  for (int j = -kWindowRadius; j <= kWindowRadius; ++j) {
    const int row = std::clamp(y + j, 0, height - 1) % kWindow;
    const std::uint8_t* hamming = m.hamming_rows.data() + row * row_size;
    for (std::size_t i = 0; i < row_size; ++i) {
      m.column_sums[i] = static_cast<std::uint16_t>(m.column_sums[i] + hamming[i]);
    }
  }
  for (int x = 0; x < width; ++x) {
    std::uint8_t* out = m.cost.data() + x * D;
    const std::uint16_t* columns[kWindow];
    for (int i = 0; i < kWindow; ++i) {
      columns[i] = m.column_sums.data() + std::clamp(x + i - kWindowRadius, 0, width - 1) * D;
    }
    for (int d = 0; d < D; ++d) {
      unsigned sum = 0;
      for (const std::uint16_t* column : columns) sum += column[d];
      out[d] = static_cast<std::uint8_t>(sum);
    }
  }
}

// The right eye's winners of one row: for each right pixel the disparity of the lowest sum.
void find_right_winners(const StereoMatcher& m) {
  const int D = m.disparities;
  std::fill(m.right_best.begin(), m.right_best.end(), std::numeric_limits<std::uint16_t>::max());
  for (int x = 0; x < m.paths.width; ++x) {
    const std::uint16_t* sum = m.sum.data() + x * D;
    for (int d = 0; d < std::min(D, x + 1); ++d) {
      if (sum[d] < m.right_best[x - d]) {
        m.right_best[x - d] = sum[d];
        m.right_disparity[x - d] = static_cast<std::uint8_t>(d);
      }
    }
  }
}

// Offset of the minimum from the middle of three costs, in ±0.5: two lines of equal and opposite
// slope through them. Less biased than a parabola for costs that grow linearly with distance.
float equiangular_offset(float left, float middle, float right) {
  const float rise = std::max(left, right) - middle;
  return rise > 0.0f ? 0.5f * (left - right) / rise : 0.0f;
}

struct RowOutcome {
  int known = 0;          // pixels that got a disparity
  std::int64_t cost = 0;  // of the winners, where every disparity lies inside the other image
};

// Writes one row of disparities.
RowOutcome choose_winners(const StereoMatcher& m, int y) {
  const int D = m.disparities;
  float* out = m.disparity.row(y);
  RowOutcome outcome;
  for (int x = 0; x < m.paths.width; ++x) {
    out[x] = kNoDisparity;
    const std::uint16_t* sum = m.sum.data() + x * D;
    const int reach = std::min(D, x + 1);
    const int d = static_cast<int>(std::min_element(sum, sum + reach) - sum);
    if (reach == D) outcome.cost += sum[d];
    if (d == D - 1) continue;  // the minimum may lie beyond what was searched
    if (std::abs(m.right_disparity[x - d] - d) > 1) continue;
    float offset = 0.0f;
    if (d > 0 && d + 1 < reach) offset = equiangular_offset(sum[d - 1], sum[d], sum[d + 1]);
    out[x] = static_cast<float>(d) + offset;
    ++outcome.known;
  }
  return outcome;
}

}  // namespace

int disparity_count(int width_px) {
  const int wanted = (width_px / 6 + 15) / 16 * 16;
  return std::clamp(wanted, 16, kMaxDisparities);
}

StereoMatcher allocate_stereo_matcher(int width_px, int height_px, Arena& arena) {
  StereoMatcher m;
  m.disparities = disparity_count(width_px);
  const std::size_t row_size = std::size_t(width_px) * m.disparities;
  m.paths.width = width_px;
  m.paths.disparities = m.disparities;
  for (int direction = 0; direction < 3; ++direction) {
    for (int parity = 0; parity < 2; ++parity) {
      m.paths.costs[direction][parity] =
          arena.allocate<std::uint8_t>(path_costs_bytes(width_px, m.disparities), "stereo paths")
              .data();
      m.paths.minima[direction][parity] =
          arena.allocate<std::uint8_t>(path_minima_bytes(width_px), "stereo path minima").data();
    }
  }
  m.paths.along =
      arena.allocate<std::uint8_t>(path_along_bytes(m.disparities), "stereo paths along").data();
  m.hamming_rows = arena.allocate<std::uint8_t>(kWindow * row_size, "stereo Hamming rows");
  m.column_sums = arena.allocate<std::uint16_t>(row_size, "stereo column sums");
  m.cost = arena.allocate<std::uint8_t>(row_size, "stereo costs");
  m.sum = arena.allocate<std::uint16_t>(row_size, "stereo path sums");
  m.right_best = arena.allocate<std::uint16_t>(width_px, "stereo right best");
  m.right_disparity = arena.allocate<std::uint8_t>(width_px, "stereo right disparity");
  m.disparity = arena.allocate_image<float>(width_px, height_px, "disparity");
  return m;
}

double match_stereo(const KernelTable& kernels, ImageView<const std::uint8_t> left_codes,
                    ImageView<const std::uint8_t> right_codes, StereoMatcher& m) {
  const int width = left_codes.width;
  const int height = left_codes.height;
  CHECK(m.disparity.has_size(width, height), "the matcher was allocated for another size");
  const std::size_t row_size = std::size_t(width) * m.disparities;
  reset_path_rows(m.paths);
  int known = 0;
  std::int64_t cost = 0;
  int next_row = 0;  // of Hamming distances
  for (int y = 0; y < height; ++y) {
    for (; next_row <= std::min(y + kWindowRadius, height - 1); ++next_row) {
      kernels.hamming_row({left_codes.row(next_row), std::size_t(width)},
                          {right_codes.row(next_row), std::size_t(width)}, m.disparities,
                          m.hamming_rows.subspan((next_row % kWindow) * row_size, row_size));
    }
    sum_window(m, y, height);
    kernels.semi_global_row(m.cost, kPenalties, m.paths, m.sum);
    find_right_winners(m);
    const RowOutcome row = choose_winners(m, y);
    known += row.known;
    cost += row.cost;
  }
  const double compared = static_cast<double>(std::max(width - m.disparities + 1, 1)) * height;
  m.mean_cost = static_cast<double>(cost) / compared;
  return static_cast<double>(known) / (static_cast<double>(width) * height);
}

bool are_eyes_swapped(const KernelTable& kernels, ImageView<const std::uint8_t> left_codes,
                      ImageView<const std::uint8_t> right_codes, StereoMatcher& matcher) {
  // Eyes the right way round agree 2.3 to 3 times better than the wrong way, on a car's, a drone's
  // and rendered images from 160 to 376 px wide.
  constexpr double kClearlyBetter = 1.5;
  (void)match_stereo(kernels, right_codes, left_codes, matcher);
  const double cost_the_other_way = matcher.mean_cost;
  (void)match_stereo(kernels, left_codes, right_codes, matcher);
  return matcher.mean_cost > kClearlyBetter * cost_the_other_way;
}

}  // namespace darkling
