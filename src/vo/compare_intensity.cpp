// SPDX-License-Identifier: Apache-2.0
#include "vo/compare_intensity.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/check.h"
#include "vo/limits.h"

namespace darkling {

namespace {

constexpr int kReach = 4;
constexpr std::array<int, 2 * kReach + 1> kBinomial = {1, 8, 28, 56, 70, 56, 28, 8, 1};  // of 256

// A row that is summed down its columns, at most 255 · 256, between pixels that stand in beyond it.
using SummedRow = std::array<int, kMaxWidth + 2 * kReach>;

void sum_columns(ImageView<const std::uint8_t> grey, int y, SummedRow& summed) {
  int* const sums = summed.data() + kReach;
  std::fill_n(sums, grey.width, 0);
  for (int j = -kReach; j <= kReach; ++j) {
    const std::uint8_t* row = grey.row(std::clamp(y + j, 0, grey.height - 1));
    for (int x = 0; x < grey.width; ++x) sums[x] += kBinomial[j + kReach] * row[x];
  }
  std::fill_n(sums - kReach, kReach, sums[0]);
  std::fill_n(sums + grey.width, kReach, sums[grey.width - 1]);
}

void spread_row(const SummedRow& summed, int width, std::uint8_t* planes) {
  for (int x = 0; x < width; ++x) {
    int sum = 1 << 15;
    for (int i = 0; i <= 2 * kReach; ++i) sum += kBinomial[i] * summed[x + i];
    std::memset(planes + x * kPlaneCount, sum >> 16, kPlaneCount);
  }
}

}  // namespace

KernelTable compare_intensity(const KernelTable& kernels) {
  KernelTable table = kernels;
  table.bit_planes = intensity_planes;
  table.normal_equations = intensity_normal_equations;
  return table;
}

void intensity_planes(ImageView<const std::uint8_t> grey, int dead_zone,
                      ImageView<std::uint8_t> codes, std::span<std::uint8_t> scratch,
                      ImageView<std::uint8_t> planes) {
  if (!codes.is_empty()) bit_planes_ref(grey, dead_zone, codes, scratch, {});
  if (planes.is_empty()) return;
  CHECK(planes.has_size(kPlaneCount * grey.width, grey.height), "eight bytes of planes a pixel");
  CHECK(grey.width <= kMaxWidth, "a row fits kMaxWidth");
  SummedRow summed;
  for (int y = 0; y < grey.height; ++y) {
    sum_columns(grey, y, summed);
    spread_row(summed, grey.width, planes.row(y));
  }
}

void intensity_normal_equations(const TemplatePoints& points, const PointResiduals& residuals,
                                float focal_px, float inverse_scale, NormalSums& sums) {
  constexpr float kWider = 3.0f;
  normal_equations_ref(points, residuals, focal_px, inverse_scale / (kWider * kWider), sums);
}

}  // namespace darkling
